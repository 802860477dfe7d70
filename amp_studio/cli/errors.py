"""What the command line refuses."""


class UsageFault(Exception):
    """Input that cannot be used; the text is the one line the user sees."""
