"""merge with sides taken, as git's merge driver, and diff with other versions of a file."""

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.schema import Value
from tests.campaigns import some

CALIBRATION = ("home.calibration", "1")


@pytest.fixture
def three(amp, mill: Path) -> tuple[Path, Path, Path]:
    """Return a base, ours and theirs: one conflict, one change of ours, two of theirs."""
    ours, theirs = (mill.with_name(f"{name}.amp") for name in ("ours", "theirs"))
    for path in (ours, theirs):
        path.write_bytes(mill.read_bytes())
    amp("set", ours, "1300=1", "2300=3")
    amp("set", theirs, "1300=7", "1320=2", "1350=20 mm/s")
    return mill, ours, theirs


@pytest.mark.parametrize(
    ("take", "value"),
    some([(["theirs"], 7.0), (["ours"], 1.0), (["base"], 0.0), (["theirs", "1300=ours"], 1.0)], 2),
)
def test_a_conflict_is_settled_by_taking_a_side(amp, three, take: list[str], value: float) -> None:
    out = three[0].with_name("merged.amp")
    options = [text for side in take for text in ("--take", side)]
    sentence = amp("merge", *three, "-o", out, *options)
    assert (sentence.code, sentence.out.splitlines()[-1]) == (0, f"{out}: 0 conflicts")
    assert open_file(out).file.get(CALIBRATION) == Value(value, "mm")


def test_a_side_may_be_taken_where_only_one_side_changed_a_value(amp, three) -> None:
    out = three[0].with_name("merged.amp")
    assert amp("merge", *three, "-o", out, "--take", "1320=ours", "--take", "theirs").code == 0
    assert open_file(out).file.get(("zone.overtravel_positive", "1")) == Value(0.0, "mm")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--take", "mine"], "'mine' is no side: base, ours, theirs"),
        (["--take", "1300=mine"], "'mine' is no side"),
        (["--take", "9999=ours"], "9999"),
    ],
)
def test_a_side_that_is_none_is_refused_and_nothing_is_written(
    amp, three, folder, options: list[str], message: str
) -> None:
    before = folder()
    sentence = amp("merge", *three, "-o", three[0].with_name("merged.amp"), *options)
    assert (sentence.code, message in sentence.err) == (2, True)
    assert before == folder()


def test_a_dry_run_lists_the_conflicts_and_writes_nothing(amp, three, folder) -> None:
    before = folder()
    sentence = amp("merge", *three, "--dry-run")
    assert sentence.out.splitlines() == [
        "conflict at 1300 Home Calibration: base 0 mm, ours 1 mm, theirs 7 mm; ours is kept",
        "nothing written: 1 conflict",
    ]
    assert (sentence.code, folder()) == (1, before)


def test_a_merge_as_json_has_conflicts_changes_and_new_findings(amp, three) -> None:
    out = three[0].with_name("merged.amp")
    sentence = amp("merge", *three, "-o", out, "--json")
    conflict = {
        "param": "1300",
        "id": "home.calibration",
        "instance": "1",
        "base": "0 mm",
        "ours": "1 mm",
        "theirs": "7 mm",
        "taken": None,
        "result": "1 mm",
    }
    assert (sentence.code, sentence.json["conflicts"], sentence.json["output"]) == (1, [conflict], str(out))
    changes = {each["param"]: each["taken"] for each in sentence.json["changes"]}
    assert changes == {"1320": "theirs", "1350": "theirs"}
    assert sentence.json["findings"] == []


def test_a_finding_that_only_the_result_has_is_named(amp, checkout: Path, tmp_path: Path) -> None:
    base, ours, theirs = (tmp_path / f"{name}.amp" for name in ("base", "ours", "theirs"))
    for path, gain_break, suppression in ((base, 5, 13), (ours, 12, 13), (theirs, 5, 11)):
        path.write_bytes((checkout / "examples/mill-1394/MILL_1394.amp").read_bytes())
        amp("set", path, f"1730={gain_break}", f"1740={suppression}", "1750=14")
    out = tmp_path / "merged.amp"
    sentence = amp("merge", base, ours, theirs, "-o", out)
    assert (sentence.code, sentence.out) == (0, f"{out}: 0 conflicts\n")
    assert "new in the result: warning 1730 Gain Break Point" in sentence.err
    (finding,) = amp("merge", base, ours, theirs, "--dry-run", "--json").json["findings"]
    assert set(finding["params"]) == {"1730", "1740"}


def test_values_whose_unit_follows_their_axis_are_named(amp, three) -> None:
    base, ours, theirs = three
    amp("set", theirs, "axis.type@X=rotary")
    sentence = amp("merge", base, ours, theirs, "-o", base.with_name("merged.amp"), "--take", "ours")
    assert "the unit follows with the same figure: 1300 Home Calibration" in sentence.err
    assert open_file(base.with_name("merged.amp")).file.get(CALIBRATION) == Value(1.0, "deg")


def test_remarks_of_ours_stay_in_the_result(amp, three) -> None:
    text = three[1].read_text().replace("\nvalues:", "\n# measured by J. Doe\nvalues:", 1)
    three[1].write_text(text)
    out = three[0].with_name("merged.amp")
    amp("merge", *three, "-o", out, "--take", "theirs")
    assert "# measured by J. Doe" in out.read_text()


# -- git


@pytest.fixture
def git(
    tmp_path: Path, mill: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[..., subprocess.CompletedProcess]:
    """Return what runs git in a repository of parameter files, whose merge driver is this program."""
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
    monkeypatch.setenv("GIT_CONFIG_SYSTEM", "/dev/null")
    for role in ("AUTHOR", "COMMITTER"):
        monkeypatch.setenv(f"GIT_{role}_NAME", "J. Doe")
        monkeypatch.setenv(f"GIT_{role}_EMAIL", "doe@example.org")

    def run(*arguments: str) -> subprocess.CompletedProcess:
        command = ["git", "-c", "init.defaultBranch=main", *arguments]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=60)

    run("init", "-q")
    program = f'"{sys.executable}" -m amp_studio.cli'
    run("config", "merge.amp.driver", f"{program} merge --git %O %A %B -o %A")
    (tmp_path / ".gitattributes").write_text("*.amp merge=amp\n")
    (tmp_path / ".gitignore").write_text("*.amp.bak\n*.amp.history\n.*.lock\n")
    run("add", ".")
    run("commit", "-qm", "base")
    return run


def test_git_merges_parameter_files_by_parameter_and_leaves_nothing_behind(amp, git, mill: Path) -> None:
    git("checkout", "-qb", "spindle")
    amp("set", mill, "1300=1", "2300=3")
    git("commit", "-qam", "theirs")
    git("checkout", "-q", "main")
    amp("set", mill, "1300=1 mm", "1320=2")  # beside the line that the other branch changes
    git("commit", "-qam", "ours")
    sentence = git("merge", "-q", "-m", "merged", "spindle")
    assert (sentence.returncode, sentence.stderr) == (0, ""), sentence.stdout
    file = open_file(mill).file
    values = [file.get(file.find(number)) for number in ("1300", "2300", "1320")]
    assert values == [Value(1.0, "mm"), Value(3.0, "mm"), Value(2.0, "mm")]
    assert git("status", "--porcelain").stdout == ""
    assert file.header.name == "mill"


def test_git_gets_a_conflict_and_the_file_stays_readable(amp, git, mill: Path) -> None:
    git("checkout", "-qb", "spindle")
    amp("set", mill, "1300=1")
    git("commit", "-qam", "theirs")
    git("checkout", "-q", "main")
    amp("set", mill, "1300=2")
    git("commit", "-qam", "ours")
    sentence = git("merge", "spindle")
    assert sentence.returncode == 1
    assert (
        "conflict at 1300 Home Calibration: base 0 mm, ours 2 mm, theirs 1 mm; ours is kept"
        in sentence.stdout
    )
    assert "mill: 1 conflict\n" in sentence.stdout, "not the name that git gives its copy"
    assert git("status", "--porcelain").stdout == "UU mill.amp\n"
    assert open_file(mill).file.get(CALIBRATION) == Value(2.0, "mm")


def test_a_file_that_both_branches_added_is_merged_without_a_base(amp, git, mill: Path) -> None:
    content = mill.read_bytes()
    git("rm", "-q", "mill.amp")
    git("commit", "-qm", "none")
    for branch, setting in (("one", "1300=0"), ("two", "1320=5")):
        git("checkout", "-qb", branch, "main")
        mill.write_bytes(content)
        amp("set", mill, setting)
        git("add", "mill.amp")
        git("commit", "-qm", branch)
    sentence = git("merge", "one")
    assert sentence.returncode == 1
    assert "conflict at 1320" in sentence.stdout
    assert "1300" not in sentence.stdout


# -- diff


def test_a_file_is_compared_with_its_defaults_and_with_its_backup(amp, mill: Path) -> None:
    amp("set", mill, "1300=2")
    amp("set", mill, "1300=3")
    rows = amp("diff", mill, "--defaults", "--json").json["differences"]
    assert {"param": "1300", "a": "3 mm", "b": "0 mm"}.items() <= next(
        r for r in rows if r["param"] == "1300"
    ).items()
    (row,) = amp("diff", mill, "--backup", "--json").json["differences"]
    assert (row["param"], row["a"], row["b"]) == ("1300", "3 mm", "2 mm")


def test_one_axis_is_compared_with_another_by_letter_or_number(amp, mill: Path) -> None:
    amp("set", mill, "1350=20 mm/s")
    for axes in (("X", "Y"), ("1", "2")):
        (row,) = amp("diff", mill, "--axes", *axes, "--json").json["differences"]
        assert (row["param"], row["a"]) == ("1350", "20 mm/s")


def test_axes_of_two_machines_are_matched_by_their_letters_when_asked(
    amp, mill: Path, tmp_path: Path
) -> None:
    other = tmp_path / "other.amp"
    amp("new", "9pc", other, "--machine", "mill", "--axes", "Y,X,A,S")
    amp("set", other, "1350=20 mm/s")  # axis Y there
    rows = amp("diff", mill, other, "--by-letter", "--json")
    assert [r["param"] for r in rows.json["differences"] if r["instance"] in "12"] == ["2350"]
    assert "axis Y is axis 1 in B; it is compared as axis 2" in rows.err


def test_a_difference_of_three_shows_who_changed_it(amp, three) -> None:
    base, ours, theirs = three
    rows = amp("diff", ours, theirs, "--base", base, "--json").json["differences"]
    kinds = {row["param"]: (row["base"], row["kind"]) for row in rows}
    assert kinds["1300"] == ("0 mm", "conflict")
    assert (kinds["2300"][1], kinds["1320"][1]) == ("a", "b")
    text = amp("diff", ours, theirs, "--base", base).out
    assert "base 0 mm  |  A 1 mm  |  B 7 mm  (both changed it)" in text


@pytest.mark.parametrize("sides", [(), ("--defaults", "--backup"), ("B", "--defaults")])
def test_a_comparison_has_one_other_side(amp, mill: Path, sides: tuple[str, ...]) -> None:
    sentence = amp("diff", mill, *(str(mill) if side == "B" else side for side in sides))
    assert (sentence.code, "diff takes one other side" in sentence.err) == (2, True)


def test_a_file_that_was_never_downloaded_has_no_last_download(amp, mill: Path) -> None:
    sentence = amp("diff", mill, "--last-download")
    assert (sentence.code, "No download of mill.amp is recorded" in sentence.err) == (2, True)


def test_many_machines_are_compared_by_groups_that_agree(amp, mill: Path, tmp_path: Path) -> None:
    paths = [tmp_path / f"line{n}.amp" for n in range(1, 10)]
    for path in paths:
        path.write_bytes(mill.read_bytes())
    assert amp("compare", *paths).out.splitlines()[-1].startswith("0 listed, ")
    for path, settings in {
        paths[2]: ("1300=2",),
        paths[3]: ("1300=2", "2300=4"),
        paths[4]: ("1300=2", "2300=4"),
    }.items():
        amp("set", path, *settings)
    done = amp("compare", *paths)
    assert done.code == 1
    *lines, end = done.out.splitlines()
    assert end.startswith("2 listed, ")
    assert lines == [
        "group 1, 6 machines: line1, line2, line6, line7, line8, line9",
        "group 2, 2 machines: line4, line5",
        "group 3, 1 machine: line3",
        f"{'1300 Home Calibration':52} 0 mm (1)  |  2 mm (2-3)",
        f"{'2300 Home Calibration':52} 0 mm (1, 3)  |  4 mm (2)",
    ]
    groups = amp("compare", *paths, "--json").json["groups"]
    assert [[Path(name).stem for name in group] for group in groups] == [
        ["line1", "line2", "line6", "line7", "line8", "line9"],
        ["line4", "line5"],
        ["line3"],
    ]


def test_long_lists_of_machines_are_shortened_and_whole_where_that_is_asked_for(
    amp, mill: Path, tmp_path: Path
) -> None:
    text, paths = mill.read_text("utf-8"), [tmp_path / f"machine{n:02}.amp" for n in range(32)]
    for n, path in enumerate(paths):
        figure = "1.5 mm" if n < 20 else f"{n} mm"
        path.write_text(re.sub("(?m)^( *home.calibration@1: ).*", rf"\g<1>{figure}", text), "utf-8")
    short, whole = (amp("compare", *paths, *more).out.splitlines() for more in ((), ("--in-full",)))
    assert max(map(len, (*short, *whole))) <= 110
    assert short[0].startswith("group 1, 20 machines: machine00, ")
    assert short[1].strip().endswith("machine11, … and 8 more")
    assert [line.strip() for line in short[-3:-1]] == ["26 mm (8)", "… and 5 more"]
    assert "machine19" in " ".join(whole)
    assert [line.strip() for line in whole[-3:-1]] == ["30 mm (12)", "31 mm (13)"]
