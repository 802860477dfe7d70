"""A command line that cannot be used is answered in plain words, with the nearest name, and changes
nothing.
"""

from pathlib import Path

import pytest


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("show 9pc 1300 1301", "Unexpected argument: 1301 (see 'amp-studio show --help')"),
        ("show 9pc 1300 1301 1302", "Unexpected arguments: 1301 1302 (see 'amp-studio show --help')"),
        (
            "validate mill.amp -x",
            (
                "Unknown option '-x'. Known: -h, --help, --jobs, --rules, --motion, --why, --no-cache,"
                " --format, --json, --family, --machine"
            ),
        ),
        ("validate mill.amp --jsn", "Did you mean: --json, --jobs (see"),
        ("validate", "Missing: PATH (see 'amp-studio validate --help')"),
        ("set mill.amp", "Missing: PARAM=VALUE (see 'amp-studio set --help')"),
        ("validate mill.amp --j", "'--j' is the beginning of several options: --jobs, --json (see"),
        ("validate mill.amp --json=3", "--json takes no value, and was given '3' (see"),
        ("validate mill.amp --rules", "--rules needs a value (see"),
        ("validate mill.amp --jobs two", "--jobs: two is no number from 1 to 100000 (see"),
        ("validate mill.amp --jobs ²", "--jobs: ² is no number from 1 to 100000 (see"),
        (
            "report mill.amp -o mill.txt --output=mill.csv",
            "-o names one file, and was given mill.txt and mill.csv (see 'amp-studio report --help')",
        ),
        (
            "report mill.amp -o mill.txt --sort axs",
            "Unknown sort 'axs'. Known: axis, number, group, steps. Did you mean: axis",
        ),
        ("nwe 9pc", "Unknown verb 'nwe'. Did you mean: new (see 'amp-studio --help')"),
        ("import notes.txt -o new.amp", "notes.txt: Unrecognised file format. Known: csv, patch, num, "),
        ("import notes.txt -o new.amp --format nun", "Did you mean: num"),
    ],
)
def test_a_command_line_that_cannot_be_used(
    amp, mill: Path, monkeypatch: pytest.MonkeyPatch, line: str, message: str
) -> None:
    monkeypatch.chdir(mill.parent)
    Path("notes.txt").write_text("nothing of a control\n")
    before = sorted(mill.parent.iterdir())
    sentence = amp(*line.split())
    assert sentence.code == 2
    assert sentence.err.startswith("amp-studio: ")
    assert message in sentence.err
    assert sentence.out == ""
    assert sorted(mill.parent.iterdir()) == before
