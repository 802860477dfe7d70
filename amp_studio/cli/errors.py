"""What the command line refuses."""

from amp_studio.errors import AmpStudioError


class UsageError(AmpStudioError):
    """Input that cannot be used; the text is the one line the user sees."""
