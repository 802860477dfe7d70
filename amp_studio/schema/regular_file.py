"""The one gate through which a named path is read: a file of bounded size,
or an error with what it is instead.

A named pipe would be waited for, /dev/zero would fill the memory, and opening a serial port moves its lines.
So the kind is checked before anything is opened, and again on the open handle:
the name may mean something else by then.
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

MAX_BYTES = 16 * 2**20
"""Some hundred times the largest parameter file of a machine."""
_AT_ONCE = 2**20
_KINDS = {
    stat.S_IFDIR: "Is a directory",
    stat.S_IFIFO: "Is a named pipe, not a file",
    stat.S_IFSOCK: "Is a socket, not a file",
    stat.S_IFCHR: "Is a device, not a file",
    stat.S_IFBLK: "Is a device, not a file",
    stat.S_IFLNK: "Is a link, not a file",
}
# Neither waiting for the other end of a pipe, nor made the terminal of this program, nor changing line ends
# on Windows.
HARMLESS = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)
NO_LINK = getattr(os, "O_NOFOLLOW", 0)


def read_file(path: Path, limit: int = MAX_BYTES, *, follow: bool = True, tail: bool = False) -> bytes:
    """Return the content of a file.

    With ``follow=False`` the path itself must not be a link; with ``tail`` the end of a file longer than
    ``limit`` bytes is returned. Raises OSError with the path and one sentence: for what cannot be read,
    is not a file or is too large.
    """
    try:
        demand_file(path.stat(follow_symlinks=follow))
        handle = os.open(path, os.O_RDONLY | HARMLESS | (0 if follow else NO_LINK))
        try:
            found = os.fstat(handle)
            demand_file(found)
            if tail and found.st_size > limit:
                os.lseek(handle, -limit, os.SEEK_END)
            elif found.st_size > limit:
                raise _too_large(limit)
            content = _read(handle, limit)
        finally:
            os.close(handle)
    except OSError as error:
        # In one form, with the path, whichever of the calls above has failed.
        raise OSError(error.errno, error.strerror or str(error), str(path)) from None
    return content


def read_table_text(path: Path) -> str:
    """Return the text of a table that an instrument or a spreadsheet wrote, in the encoding that it has;
    raises OSError.
    """
    content = read_file(path)
    wide = content[:2] in (b"\xff\xfe", b"\xfe\xff")  # "Unicode text" of a spreadsheet
    try:
        return content.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")  # a degree sign of an older program


def demand_file(status: os.stat_result) -> None:
    """Raise OSError for what is not a file."""
    kind = stat.S_IFMT(status.st_mode)
    if kind != stat.S_IFREG:
        number = errno.EISDIR if kind == stat.S_IFDIR else errno.EINVAL
        raise OSError(number, _KINDS.get(kind, "Is not a file"))


def _read(handle: int, limit: int) -> bytes:
    """Read to the end; a file may grow meanwhile, and those of /proc have no size."""
    # One byte more than allowed: only a read that goes too far shows that a file has grown.
    parts, left = [], limit + 1
    while left and (part := os.read(handle, min(left, _AT_ONCE))):
        parts.append(part)
        left -= len(part)
    if not left:
        raise _too_large(limit)
    return b"".join(parts)


def _too_large(limit: int) -> OSError:
    size = f"{limit // 2**20} MiB" if limit >= 2**20 else f"{limit} bytes"
    return OSError(errno.EFBIG, f"Is larger than {size}, the most that is read")
