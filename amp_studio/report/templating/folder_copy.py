"""A copy of a project's templates, without links: what jinja2 and Typst can read of a template is in it,
and nothing else is. A file with a second name (a hard link) is one too: it may be any file of the same disk.
"""

from __future__ import annotations

import contextlib
import stat
from collections.abc import Iterator
from pathlib import Path

from amp_studio.schema import read_file

from .templates import TemplateMistakeError

_MAX_BYTES = 64 * 2**20
"""Of all files beside a template: logos and pictures."""
_MAX_FILES = 1_000


@contextlib.contextmanager
def copied_template(own: Path) -> Iterator[Path]:
    """Give the copy of a template in a copy of its folder, both gone afterwards; raises TemplateMistakeError.

    A link could lead to any file of the user, whose content the report would show: it is left out, and a
    template that is one itself, or lies in a folder that is one, is refused.
    What goes wrong inside names the template itself.
    """
    import tempfile  # most reports have no template of their own

    with tempfile.TemporaryDirectory(prefix="amp-studio-templates-") as folder:
        try:
            links = _copy(own.parent, Path(folder)) if not own.parent.is_symlink() else [own.parent]
        except OSError as error:
            raise TemplateMistakeError(own, f"cannot be read: {error.strerror}") from None
        if own in links or own.parent in links:
            raise TemplateMistakeError(own, "is a link or lies in one: links are not followed")
        try:
            yield Path(folder) / own.name
        except TemplateMistakeError as error:
            names = ", ".join(link.name for link in links[:5])
            mistake = error.mistake.replace(folder, str(own.parent))
            raise TemplateMistakeError(
                own, f"{mistake} (links are not followed: {names})" if links else mistake
            ) from None


def _copy(source: Path, target: Path) -> list[Path]:
    """Copy the files of a folder and of those in it; returns the links, which are left out. Raises
    OSError.
    """
    links, folders, files, size = list[Path](), [(source, target)], 0, 0
    while folders:
        here, there = folders.pop()
        for path in sorted(here.iterdir()):
            # Of the link itself, not of what it leads to.
            status = path.lstat()
            mode = status.st_mode
            if stat.S_ISLNK(mode) or (stat.S_ISREG(mode) and status.st_nlink > 1):
                links.append(path)
            elif stat.S_ISDIR(mode):
                (there / path.name).mkdir()
                folders.append((path, there / path.name))
            elif stat.S_ISREG(mode):
                # A file may have become a link since it was listed.
                content = read_file(path, _MAX_BYTES, follow=False)
                files, size = files + 1, size + len(content)
                if files > _MAX_FILES or size > _MAX_BYTES:
                    raise OSError(0, f"its folder has more than {_MAX_FILES} files or {_MAX_BYTES >> 20} MB")
                (there / path.name).write_bytes(content)
    return links
