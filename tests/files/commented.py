"""A parameter file as a person wrote it: remarks, blank lines, spellings of his own."""

from pathlib import Path

COMMENTED = """\
# The bench of hall 4
amp_studio: 1
family: 9pc
# measured in spring
builder: {name: me, parts: [1, 2.50, yes]}
values:
  # the machine
  control.type: Mill   # not a lathe
  axis.type@1: linear
  # home, measured twice

  home.calibration@1: 1.5 mm   # +- 0.1
  # to be checked
  home.position@1: 0.25 in
  axis.name@1: X
  # end of the values
# end of the file
...
"""


def edited(path: Path, old: str, new: str) -> Path:
    """Change the text of a file as a person would."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return path
