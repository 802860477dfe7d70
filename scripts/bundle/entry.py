"""Where the program of the folder starts (``make bundle``).

It is its own interpreter too: what starts a process apart by ``sys.executable`` with ``-m MODULE`` or ``-c
CODE`` gets what Python's would give, as far as this program asks for it.
"""

import multiprocessing
import runpy
import sys


def main() -> None:
    """Run what Python would run for ``-m`` and ``-c``, else the command line, without arguments the
    window.
    """
    multiprocessing.freeze_support()
    given = sys.argv[1:]
    while given[:1] in (["-P"], ["-I"], ["-u"]):  # nothing is ever imported from the folder at hand
        given = given[1:]
    if given[:1] == ["-m"]:
        sys.argv = given[1:]
        runpy.run_module(given[1], run_name="__main__", alter_sys=True)
    elif given[:1] == ["-c"]:
        sys.argv = ["-c", *given[2:]]
        exec(given[1], {"__name__": "__main__"})  # noqa: S102  # as Python does it, of this program's own text
    else:
        from amp_studio.cli import main as command_line

        command_line()


if __name__ == "__main__":
    main()
