"""The base of every error that this program raises on purpose."""


class AmpStudioError(Exception):
    """What was asked for cannot be done; the text is one sentence for the user.

    The ``at_control`` of an error of an exchange, and its text, name what the control contains.
    """

    def __reduce__(self) -> tuple[object, ...]:
        """Return what makes it again in another process: Python would call ``__init__`` with the text, and
        several take something else.
        """
        return _made_again, (type(self), self.args, vars(self))


def _made_again(kind: type[AmpStudioError], args: tuple[object, ...], state: dict[str, object]) -> Exception:
    error = kind.__new__(kind, *args)
    error.args = args
    vars(error).update(state)
    return error
