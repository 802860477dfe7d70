"""Owner, permissions and attributes of a file,
which the new file that takes its name would not have by itself.
"""

from __future__ import annotations

import contextlib
import os
import stat
import sys
from pathlib import Path

assert sys.platform != "win32"  # which gives a new file those of its folder


def keep_attributes(old: Path, handle: int) -> list[str]:
    """Give an open new file the owner, the mode and the attributes of an old one;
    return a sentence for what cannot be kept.
    """
    was = old.stat()
    now = _with_owner_of(was, handle)
    notes, mode = [], stat.S_IMODE(was.st_mode)
    if (now.st_uid, now.st_gid) != (was.st_uid, was.st_gid):
        notes.append(f"owner and group are now {_owners(now)}; {_owners(was)} could not be kept")
        # Set-user and set-group bits were for the owner that it had.
        mode &= 0o777
    if now.st_gid != was.st_gid:  # what was allowed to the one group is not given to another
        mode = mode & 0o707 | (mode & 0o007) << 3
    try:
        os.fchmod(handle, mode)
    except OSError as error:
        notes.append(f"its permissions could not be kept: {error.strerror}")
    notes += _keep_extended(old, handle)
    if was.st_nlink == 2:
        notes.append("1 other name of this file (a hard link) still has the old content")
    elif was.st_nlink > 2:
        notes.append(f"{was.st_nlink - 1} other names of this file (hard links) still have the old content")
    return notes


def _with_owner_of(was: os.stat_result, handle: int) -> os.stat_result:
    """Give a file the owner and group of another as far as this user may; return what it has then."""
    # Who may not give it to another user may give it to a group of his own.
    for user in (was.st_uid, -1):
        now = os.fstat(handle)
        if (now.st_uid, now.st_gid) == (was.st_uid, was.st_gid):
            break
        with contextlib.suppress(OSError):
            os.fchown(handle, user, was.st_gid)
    return os.fstat(handle)


def _owners(status: os.stat_result) -> str:
    """Return owner and group by name where they have one."""
    import grp
    import pwd

    names = [str(status.st_uid), str(status.st_gid)]
    with contextlib.suppress(KeyError):
        names[0] = pwd.getpwuid(status.st_uid).pw_name
    with contextlib.suppress(KeyError):
        names[1] = grp.getgrgid(status.st_gid).gr_name
    return ":".join(names)


def _keep_extended(old: Path, handle: int) -> list[str]:
    """Copy extended attributes, access control lists among them;
    labels of the system's own are given by the system.
    """
    if sys.platform != "linux":
        return []
    lost = []
    names: list[str] = []
    with contextlib.suppress(OSError):  # a file system without attributes
        names = [name for name in os.listxattr(old) if not name.startswith("security.")]
    for name in names:
        try:
            os.setxattr(handle, name, os.getxattr(old, name))
        except OSError:
            lost.append("the access control list" if name.startswith("system.posix_acl") else name)
    return [f"{', '.join(lost)} could not be kept"] if lost else []
