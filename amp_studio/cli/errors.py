"""What the command line refuses."""


class UsageError(Exception):
    """Input that cannot be used; the text is the one line the user sees."""
