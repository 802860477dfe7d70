"""What the tests of axes share."""

from amp_studio.files import ParameterFile


def taken_back(file: ParameterFile, changes) -> dict:
    """Return the values after the changes have been taken back."""
    for change in reversed(changes):
        file.apply(change.reversed())
    return dict(file.values)
