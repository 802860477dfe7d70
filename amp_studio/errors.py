"""The base of every error that this program raises on purpose."""


class AmpStudioError(Exception):
    """What was asked for cannot be done; the text is one sentence for the user.

    The ``at_control`` of an error of an exchange, and its text, name what the control contains.
    """
