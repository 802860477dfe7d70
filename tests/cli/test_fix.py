"""The verb that makes suggested fixes: what it changes, what it leaves, and what it never brings."""

import json
from pathlib import Path

import pytest

from amp_studio.files.example_files import examples_folder
from amp_studio.guide import summary_of

RULES = """
rules:
  - id: own.rapid
    title: Rapid of our mills
    severity: error
    reads: {rapid: feedrate.rapid@1}
    check: rapid <= 9000.0
    message: Rapid is {rapid}.
    fix: [{set: rapid, value: "9000.0"}]
  - id: own.rapid-again
    title: Rapid of our mills, in other words
    severity: warning
    reads: {rapid: feedrate.rapid@1}
    check: rapid <= 9500.0
    message: Rapid is {rapid}.
    fix: [{set: rapid, value: "9400.0"}]
"""


@pytest.fixture
def broken(checkout: Path, tmp_path: Path, amp) -> Path:
    """Return a mill whose excess error is too small for its rapid, and whose suppression is switched off."""
    path = tmp_path / "mill.amp"
    path.write_bytes((checkout / "examples/mill-1394/MILL_1394.amp").read_bytes())
    assert amp("set", path, "1203=10000 mm/min", "1750=8 mm", "1740=8 mm", "1730=2 mm").code == 0
    return path


def test_a_fix_is_made_saved_and_reported_with_its_rule(broken: Path, amp) -> None:
    before = broken.read_bytes()
    message = amp("fix", broken, "--rule", "9pc.servo.excess-below-following-error")
    assert (
        "1750 Excess Error: 8 mm -> 11 mm (9pc.servo.excess-below-following-error)"
        in message.out.splitlines()
    )
    assert "1740 Feedrate Suppression Point: 8 mm -> 11 mm" in message.out, "what was off stays off"
    assert b"servo.excess_error@1: 11 mm" in broken.read_bytes()
    assert broken.with_name("mill.amp.bak").read_bytes() == before
    how = {json.loads(line)[2] for line in broken.with_name("mill.amp.history").read_text().splitlines()[-2:]}
    assert how == {"fix"}


def test_the_json_has_the_changes_and_what_is_left(broken: Path, amp) -> None:
    message = amp("fix", broken, "--rule", "9pc.servo.excess-below-following-error", "--json")
    checked = amp("validate", broken, "--json").json
    rule = "9pc.servo.excess-below-following-error"
    assert message.json == {
        "file": str(broken),
        "changes": [
            {
                "param": "1750",
                "id": "servo.excess_error",
                "instance": "1",
                "old": "8 mm",
                "new": "11 mm",
                "rule": rule,
            },
            {
                "param": "1740",
                "id": "servo.feedrate_suppression",
                "instance": "1",
                "old": "8 mm",
                "new": "11 mm",
                "rule": rule,
            },
        ],
        "left": {key: checked[key] for key in ("errors", "warnings", "advice")},
        "dry_run": False,
    }
    assert message.code == int(checked["errors"] > 0)


def test_a_dry_run_shows_the_same_and_touches_nothing(broken: Path, amp, folder) -> None:
    before = folder()
    tried = amp("fix", broken, "--dry-run", "--json").json
    assert folder() == before
    assert tried.pop("dry_run") is True
    done = amp("fix", broken, "--json").json
    done.pop("dry_run")
    assert tried == done
    assert done["changes"]


def test_afterwards_nothing_more_is_offered(broken: Path, amp, folder) -> None:
    amp("fix", broken)
    assert [f["fix"] for f in amp("validate", broken, "--json").json["findings"] if f["fix"]] == []
    before = folder()
    again = amp("fix", broken)
    assert again.err == f"{broken}: nothing to fix\n"
    assert folder() == before


def test_no_error_comes_that_was_not_there(broken: Path, amp) -> None:
    def errors() -> set[tuple[str, ...]]:
        findings = amp("validate", broken, "--json").json["findings"]
        return {(f["rule"], *f["params"]) for f in findings if f["severity"] == "error"}

    before = errors()
    amp("fix", broken)
    assert errors() < before


def test_the_more_severe_finding_comes_first_and_the_builders_rules_count(broken: Path, amp) -> None:
    broken.with_name("rules.yaml").write_text(RULES)
    message = amp("fix", broken, "--param", "1203", "--json").json
    assert [(c["param"], c["new"], c["rule"]) for c in message["changes"]] == [
        ("1203", "9000 mm/min", "own.rapid")
    ]


def test_a_fix_that_breaks_a_rule_of_the_builder_is_not_made(broken: Path, amp) -> None:
    broken.with_name("rules.yaml").write_text(
        "rules:\n  - {id: own.excess, title: Excess, severity: error, reads: {excess: servo.excess_error@1},"
        " check: excess <= 10.0, message: Too much.}\n"
    )
    message = amp("fix", broken, "--rule", "9pc.servo.excess-below-following-error", "--json")
    assert (message.code, message.json["changes"]) == (1, [])
    assert b"servo.excess_error@1: 8 mm" in broken.read_bytes()


def test_only_fixes_that_set_a_parameter(broken: Path, amp) -> None:
    for named in ("1750", "servo.excess_error", "servo.excess_error@1"):
        found = amp("fix", broken, "--param", named, "--dry-run", "--json").json["changes"]
        assert {"1750", "1740"} == {change["param"] for change in found}
    assert amp("fix", broken, "--param", "2750", "--dry-run", "--json").json["changes"] == []


def test_only_safe_fixes_leave_the_motion_alone(broken: Path, amp) -> None:
    amp("set", broken, "oci.connections=2", "--force")
    message = amp("fix", broken, "--safe", "--json")
    assert [(c["id"], c["new"]) for c in message.json["changes"]] == [("oci.connections", "1")]
    assert message.code == 1, "errors are left"


@pytest.mark.parametrize(
    ("option", "text", "reported"),
    [
        (
            "--rule",
            "9pc.servo.excess-margins",
            "Unknown rule '9pc.servo.excess-margins'. Did you mean: 9pc.servo.excess-margin",
        ),
        ("--rule", "", "Unknown rule ''"),
        ("--param", "servo.exces_error@1", "servo.excess_error"),
        ("--param", "99999", "99999"),
    ],
)
def test_an_unknown_name_is_refused_with_the_nearest(
    broken: Path, amp, folder, option: str, text: str, reported: str
) -> None:
    before = folder()
    message = amp("fix", broken, option, text)
    assert message.code == 2
    assert reported in message.err
    assert folder() == before


def test_a_sound_file_has_nothing_to_fix(mill: Path, amp, tmp_path: Path) -> None:
    path = tmp_path / "module.amp"
    amp("new", "57c422b", path)
    before = path.read_bytes()
    message = amp("fix", path, "--json")
    assert message.json["changes"] == []
    assert path.read_bytes() == before


def test_a_missing_file_is_refused(tmp_path: Path, amp) -> None:
    assert amp("fix", tmp_path / "none.amp").code == 2
    assert amp("fix", tmp_path / "none.amp", "--dry-run").code == 2


@pytest.mark.parametrize(
    "named", ["P21", "P21N2", "21n2", "servo.loop_gain", "servo.loop_gain@2", "SERVO.LOOP_GAIN@Z"]
)
def test_a_parameter_is_named_as_everywhere_else(named: str, tmp_path: Path, checkout: Path, amp) -> None:
    path = tmp_path / "mill.amp"
    path.write_bytes((checkout / "examples/num-1060-mill/MILL_1060.amp").read_bytes())
    assert amp("set", path, "P21N2=0").code == 0
    changes = amp("fix", path, "--param", named, "--dry-run", "--json").json["changes"]
    assert [(c["param"], c["old"]) for c in changes] == [("P21N2", "0")]


def test_the_fix_of_a_word_is_found_by_one_of_its_bits(tmp_path: Path, checkout: Path, amp) -> None:
    path = tmp_path / "mill.amp"
    path.write_bytes((checkout / "examples/num-1060-mill/MILL_1060.amp").read_bytes())
    assert amp("set", path, "P6N0=0xFF").code == 0
    changes = amp("fix", path, "--param", "P6N0.0", "--dry-run", "--json").json["changes"]
    assert [c["param"] for c in changes] == ["P6N0"]


def test_every_verb_counts_the_same_findings(tmp_path: Path, amp) -> None:
    path = tmp_path / "mill.amp"
    path.write_bytes((examples_folder() / "mill-1394" / "MILL_1394.amp").read_bytes())
    name = "home.g30_position@4"
    (row,) = amp("get", path, name, "--json").json["values"]
    amp("set", path, f"{name}={row['value'] * 10} {row['unit']}")
    found = amp("validate", path, "--json").json["findings"]
    assert [f["params"] for f in found if f["rule"] == "plausible.earlier"] == [[row["param"]]]
    count = sum(f["severity"] == "advice" for f in found)
    assert amp("fix", path, "--dry-run", "--json", "--param", "1300").json["left"]["advice"] == count
    marked = {each["param"] for each in amp("get", path, "--with-findings", "--json").json["values"]}
    assert row["param"] in marked
    assert amp("report", path, "-o", tmp_path / "report.txt").code == 0
    assert "in the backup. Is it meant?" in " ".join((tmp_path / "report.txt").read_text("utf-8").split())
    assert summary_of(path).counts["advice"] == count
