"""validate, diff, merge: what they find, how they say it, and exit code 1 for what is wrong."""

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest

from amp_studio import cli, sim
from amp_studio.cli.checks.formats import CheckResult
from amp_studio.cli.verbs.checks import validate
from amp_studio.files import open_file
from amp_studio.schema import Value

MACHINES = 6
"""In a folder."""

# -- validate


@pytest.fixture(scope="module")
def new_plain(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("new") / "plain.amp"
    assert cli.run(["new", "9pc", str(path), "--machine", "mill", "--axes", "X"]) == 0
    assert cli.run(["set", str(path), "360=unfitted"]) == 0
    return path.read_bytes()


@pytest.fixture
def plain(new_plain: bytes, tmp_path: Path) -> Path:
    """Return the path of a file in which nothing is an error: no axis is fitted."""
    path = tmp_path / "plain.amp"
    path.write_bytes(new_plain)
    return path


def test_a_file_without_errors_ends_with_0(amp, plain: Path) -> None:
    message = amp("validate", plain, "--json")
    assert (0, 0, "", str(plain)) == (message.code, message.json["errors"], message.err, message.json["file"])
    assert [finding for finding in message.json["findings"] if finding["severity"] == "error"] == []


def test_a_finding_has_the_promised_shape_and_ends_with_1(amp, mill: Path) -> None:
    amp("set", mill, "1300=1e6", "--force")
    message = amp("validate", mill, "--json")
    assert message.code == 1
    found = message.json
    assert {"file", "errors", "warnings", "findings"} <= found.keys()
    counted = {s: sum(f["severity"] == s for f in found["findings"]) for s in ("error", "warning", "advice")}
    assert (counted["error"], counted["warning"]) == (found["errors"], found["warnings"])
    assert sum(counted.values()) == len(found["findings"])
    for finding in found["findings"]:
        assert {"rule", "severity", "params", "message", "fix", "source"} <= finding.keys()
        assert all({"param", "value"} <= setting.keys() for setting in finding["fix"])
        assert "{" not in finding["message"]
    (ours,) = [f for f in found["findings"] if f["params"] == ["1300"]]
    assert (ours["rule"], ours["severity"], ours["fix"], ours["source"]) == (
        "schema.range",
        "error",
        [{"param": "1300", "value": "999999.99 mm"}],
        "5-10",
    )


def test_the_fix_of_a_finding_can_be_given_to_set(amp, mill: Path) -> None:
    amp("set", mill, "1300=1e6", "--force")
    (ours,) = [f for f in amp("validate", mill, "--json").json["findings"] if f["params"] == ["1300"]]
    assert amp("set", mill, *(f"{fix['param']}={fix['value']}" for fix in ours["fix"])).code == 0
    assert [f for f in amp("validate", mill, "--json").json["findings"] if f["params"] == ["1300"]] == []


def test_several_files_are_checked_in_one_go(amp, mill: Path, plain: Path) -> None:
    amp("set", mill, "1310=1 mm")
    message = amp("validate", plain, mill, "--json")
    assert (1, [str(plain), str(mill)]) == (
        message.code,
        [document["file"] for document in message.json["files"]],
    )
    totals = [line for line in amp("validate", plain, mill).out.splitlines() if " errors, " in line]
    assert [totals[0].startswith(f"{plain}: 0 errors"), totals[1].startswith(f"{mill}: ")] == [True, True]


@pytest.fixture
def machines(tmp_path: Path, plain: Path, mill: Path) -> Path:
    """Return a folder of files, some deeper than others, good ones and bad ones in turn."""
    folder = tmp_path / "machines"
    (folder / "hall").mkdir(parents=True)
    for n in range(MACHINES):
        where = folder if n % 3 else folder / "hall"
        (where / f"{n:02}.amp").write_bytes((plain if n % 2 else mill).read_bytes())
    (folder / "notes.txt").write_text("no parameter file", encoding="utf-8")
    return folder


def test_the_files_of_a_folder_are_checked_in_the_order_of_their_names(amp, machines: Path) -> None:
    message = amp("validate", machines, "--json")
    assert [document["file"] for document in message.json["files"]] == [
        str(path) for path in sorted(machines.rglob("*.amp"))
    ]
    assert len(message.json["files"]) == MACHINES


def test_a_folder_gives_a_list_even_of_one_file(amp, tmp_path: Path, mill: Path) -> None:
    folder = tmp_path / "one"
    folder.mkdir()
    (folder / "a.amp").write_bytes(mill.read_bytes())
    assert [document["file"] for document in amp("validate", folder, "--json").json["files"]] == [
        str(folder / "a.amp")
    ]


def test_several_processes_say_the_same_in_the_same_order(amp, machines: Path, mill: Path) -> None:
    for options in (("--json",), ("--why",)):
        alone = amp("validate", mill, machines, "--jobs", 1, *options)
        shared = amp("validate", mill, machines, "--jobs", 2, *options)
        assert (alone.code, alone.out) == (shared.code, shared.out)


@pytest.mark.skipif(sys.platform != "linux", reason="a process is a copy of this one on Linux alone")
def test_few_files_of_many_families_are_shared_among_processes_by_family(
    amp, checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folders = ("grblhal-router", "linuxcnc-mill", "syntec-mill")
    paths = [next((checkout / "examples" / name).glob("*.amp")) for name in folders]
    paths = [*paths, paths[0]]
    alone = amp("validate", *paths, "--no-cache", "--jobs", 1)
    shared: list[list[str]] = []

    def here(
        check: Callable[[Path], CheckResult], shares: Sequence[Sequence[Path]], workers: int
    ) -> Iterator[CheckResult]:
        shared.extend([path.name for path in share] for share in shares)
        return (check(path) for share in shares for path in share)

    monkeypatch.setattr(validate, "_shared", here)
    monkeypatch.setattr(validate.os, "cpu_count", lambda: 2)
    together = amp("validate", *paths, "--no-cache")
    assert (together.code, together.out, together.err) == (alone.code, alone.out, alone.err)
    assert [len(share) for share in shared] == [1, 1]  # the third one is checked here, before


def test_how_far_it_is_is_on_standard_error(amp, machines: Path, mill: Path) -> None:
    assert amp("validate", machines, "--json").err == "checked 100 %\n"
    assert amp("validate", mill, "--json").err == ""


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_file_that_cannot_be_read_does_not_hide_the_others(
    machines: Path, capsys: pytest.CaptureFixture[str], jobs: int
) -> None:
    broken = machines / "04.amp"
    broken.write_bytes(b"family: 9pc\nvalues: [\n")
    assert cli.run(["validate", str(machines), "--jobs", str(jobs), "--json"]) == 2
    out, err = capsys.readouterr()
    assert [line for line in err.splitlines() if "checked" not in line] == [
        line for line in err.splitlines() if line.startswith(f"amp-studio: {broken}, line ")
    ]
    assert str(broken) in err
    reported = json.loads(out)["files"]
    assert (len(reported), [one for one in reported if "error" in one]) == (
        MACHINES,
        [
            {
                "file": str(broken),
                "error": f"{broken}, line 3: is not readable: did not find expected node content",
            }
        ],
    )


def test_a_folder_without_files_and_no_processes_are_refused(amp, tmp_path: Path, mill: Path) -> None:
    (tmp_path / "empty").mkdir()
    assert amp("validate", tmp_path / "empty").err.endswith("empty: contains no .amp files\n")
    (tmp_path / "empty" / "listing.txt").write_text("$0=10\n$1=25\n$2=0\n$3=0\n$100=250.000\n$110=500.000\n")
    assert "name a control's own text by itself: " in amp("validate", tmp_path / "empty").err
    assert "0 is no number from 1 to 100000" in amp("validate", mill, "--jobs", 0).err
    other = amp("validate", tmp_path / "empty" / "listing.txt", "--family", "num")
    assert (other.code, "Not a text of num, but of grblhal (format grbl)" in other.err) == (2, True)


def test_copies_of_what_controls_contained_are_no_machines_of_a_folder(amp, mill: Path) -> None:
    """They were checked as machines, which the window and a project leave out."""
    copy = mill.with_name(f"{mill.stem}.before-20261130-140500.amp")
    copy.write_bytes(mill.read_bytes())
    checked = amp("validate", mill.parent, "--json")
    assert json.loads(checked.out)["files"] == [json.loads(amp("validate", mill, "--json").out)]
    remark = f"name a copy of what a control contained by itself: {copy}\n"
    assert checked.err.endswith(f"left out: 1; {remark}")
    assert str(copy) in amp("validate", copy).out
    mill.unlink()
    assert amp("validate", copy.parent).err.endswith(f": contains no .amp files of machines; {remark}")


def test_validate_writes_nothing(amp, mill: Path, folder) -> None:
    before = folder()
    amp("validate", mill)
    assert before == folder()


def test_rules_of_one_s_own_are_checked_too(amp, plain: Path, tmp_path: Path) -> None:
    rules = tmp_path / "ours.yaml"
    rules.write_text(
        "rules:\n"
        "  - id: ours.calibration\n"
        "    title: No calibration\n"
        "    severity: error\n"
        "    reads: {groups: zone.group_count}\n"
        "    check: groups > 5.0\n"
        '    message: "Zone groups are {groups}."\n'
        '    page: "1"\n'
    )
    amp("set", plain, "20=1")
    message = amp("validate", plain, "--rules", rules, "--json")
    assert (
        message.code,
        [f["message"] for f in message.json["findings"] if f["rule"] == "ours.calibration"],
    ) == (1, ["Zone groups are 1."])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("severity: error", "severity: fatal", "ours.yaml, line 4: ours.one: severity: "),
        ("zone.group_count", "zone.nothing", "ours.yaml, line 5: ours.one: reads groups: 'zone.nothing' is"),
        ("groups > 5.0", "groups >", "ours.yaml, line 6: ours.one: check: a value is missing behind '>'"),
        ("rules:", "rules: [", "ours.yaml, line 2: "),
    ],
)
def test_rules_that_cannot_be_used_are_a_finding_beside_the_others(
    amp, plain: Path, tmp_path: Path, old: str, new: str, message: str
) -> None:
    text = (
        "rules:\n  - id: ours.one\n    title: One\n    severity: error\n    reads: {groups:"
        ' zone.group_count}\n    check: groups > 5.0\n    message: no\n    page: "1"\n'
    )
    rules = tmp_path / "ours.yaml"
    assert old in text
    rules.write_text(text.replace(old, new))
    without = amp("validate", plain, "--json").json["findings"]
    reported = amp("validate", plain, "--rules", rules, "--json")
    assert reported.code == 1
    first, *others = reported.json["findings"]
    assert (first["rule"], first["severity"]) == ("rules.unusable", "error")
    assert first["message"].startswith(message)
    assert others == without


def test_rules_that_are_not_there_are_a_slip_of_the_hand(amp, plain: Path, tmp_path: Path) -> None:
    for rules in (tmp_path / "ours.yaml", tmp_path):
        refused = amp("validate", plain, "--rules", rules)
        assert (refused.code, str(rules) in refused.err) == (2, True)


def test_findings_are_suppressed_with_a_reason_and_a_name_beside_the_file(amp, plain: Path) -> None:
    amp("set", plain, "20=1")
    (plain.parent / "rules.yaml").write_text(
        "rules:\n  - {id: ours.one, title: One, severity: error, reads: {groups: zone.group_count}, check:"
        " groups > 5.0, message: \"Groups: {groups}.\"}\nsuppressions:\n  - {rule: ours.one, params: ['20'],"
        " reason: no zones here, by: J. Doe}\n"
    )
    reported = amp("validate", plain, "--json")
    assert reported.code == 0
    (left,) = reported.json["suppressed"]
    assert (left["rule"], left["by"], left["reason"]) == ("ours.one", "J. Doe", "no zones here")
    assert "1 suppressed" in amp("validate", plain).out
    report = plain.with_suffix(".txt")
    assert amp("report", plain, "-o", report).code == 0
    assert "Suppressed by J. Doe: no zones here" in " ".join(report.read_text().split())


# -- diff


@pytest.fixture
def twin(mill: Path) -> Path:
    """Return the path of a copy of the mill."""
    path = mill.with_name("twin.amp")
    path.write_bytes(mill.read_bytes())
    return path


def test_files_that_are_the_same_do_not_differ(amp, mill: Path, twin: Path) -> None:
    message = amp("diff", mill, twin, "--json")
    assert (message.code, message.json["differences"], message.err) == (0, [], "")
    assert "0 differ" in amp("diff", mill, twin).out


def test_a_difference_has_the_promised_shape_and_ends_with_1(amp, mill: Path, twin: Path) -> None:
    amp("set", twin, "1300=1.5", "1020=yes", "2300=0 in", "20=1", "1013=not-set")
    message = amp("diff", mill, twin, "--json")
    assert message.code == 1
    displayed = [{key: d[key] for key in ("param", "a", "b")} for d in message.json["differences"]]
    assert displayed == [
        {"param": "1300", "a": "0 mm", "b": "1.5 mm"},
        {"param": "20", "a": None, "b": "1"},
        {"param": "1020", "a": "False", "b": "True"},
        {"param": "servo.velocity_gear_teeth@1", "a": "1", "b": None},
    ], "0 in is 0 mm"
    back = amp("diff", twin, mill, "--json").json["differences"]
    assert [(d["param"], d["b"], d["a"]) for d in displayed] == [(d["param"], d["a"], d["b"]) for d in back]


def test_differences_for_a_user_are_one_line_each_and_counted(amp, mill: Path, twin: Path) -> None:
    amp("set", twin, "1300=1.5", "20=1", "1013=not-set")
    *lines, total = amp("diff", mill, twin).out.splitlines()
    assert len(lines) == 3
    assert lines[0].startswith("1300 Home Calibration ")
    assert lines[0].endswith("0 mm  |  1.5 mm")
    assert "3 differ, " in total
    assert "1 not set in A, 1 not set in B" in total


def test_what_the_manual_calls_dangerous_about_a_difference_is_one_line(amp, mill: Path, twin: Path) -> None:
    assert amp("set", twin, "1300=1.5", "1595=Minus", "2595=Minus").code == 0
    message = amp("diff", mill, twin)
    assert (
        message.err
        == "danger: Sign of Position Feedback (X, Y): A wrong sign can make the axis run away. (page 7-36)\n"
    )
    assert len(message.out.splitlines()) == 4, "three differences and their count"


def test_diff_writes_nothing(amp, mill: Path, twin: Path, folder) -> None:
    before = folder()
    amp("diff", mill, twin)
    assert before == folder()


# -- merge


@pytest.fixture
def three(amp, mill: Path, twin: Path) -> tuple[Path, Path, Path]:
    """Return a base, ours and theirs: one value changed by us, one by them, one by both alike."""
    theirs = mill.with_name("theirs.amp")
    theirs.write_bytes(mill.read_bytes())
    amp("set", twin, "1300=1", "2300=3")
    amp("set", theirs, "1320=2", "2300=3")
    return mill, twin, theirs


def test_a_merge_without_conflicts_ends_with_0(amp, three, tmp_path: Path, folder) -> None:
    before, out = folder(), tmp_path / "merged.amp"
    message = amp("merge", *three, "-o", out)
    assert (0, f"{out}: 0 conflicts\n") == (message.code, message.out)
    file = open_file(out).file
    values = [Value(1.0, "mm"), Value(2.0, "mm"), Value(3.0, "mm")]
    addresses = [("home.calibration", "1"), ("zone.overtravel_positive", "1"), ("home.calibration", "2")]
    assert (values, "merged") == ([file.get(a) for a in addresses], file.header.name)
    assert before == {name: content for name, content in folder().items() if name != "merged.amp"}


def test_conflicts_are_listed_and_end_with_1(amp, three, tmp_path: Path) -> None:
    amp("set", three[2], "1300=7")
    out = tmp_path / "merged.amp"
    message = amp("merge", *three, "-o", out)
    expected = "conflict at 1300 Home Calibration: base 0 mm, ours 1 mm, theirs 7 mm; ours is kept"
    assert (1, [expected, f"{out}: 1 conflict"]) == (message.code, message.out.splitlines())
    assert Value(1.0, "mm") == open_file(out).file.get(("home.calibration", "1"))


def test_a_conflict_over_an_unknown_entry_is_listed_too(amp, three, tmp_path: Path) -> None:
    for path, number in zip(three, "123", strict=True):
        path.write_text(path.read_text().replace("\n...", f"\n  future.thing@1: '{number}'\n..."))
    message = amp("merge", *three, "-o", tmp_path / "merged.amp")
    assert (message.code, "conflict at future.thing@1: ours is kept" in message.out) == (1, True)


def test_a_merge_does_not_overwrite(amp, three, folder) -> None:
    before = folder()
    message = amp("merge", *three, "-o", three[0])
    assert (message.code, "exists already" in message.err) == (2, True)
    assert before == folder()


# -- report, simulate


@pytest.mark.parametrize(("ending", "start"), [(".txt", b""), (".html", b"<")])
def test_a_report_follows_the_ending_and_leaves_the_file_alone(
    amp, mill: Path, ending: str, start: bytes
) -> None:
    before, out = mill.read_bytes(), mill.with_suffix(ending)
    message = amp("report", mill, "-o", out, "--without", "motion")
    assert (0, f"{out}\n") == (message.code, message.out)
    assert out.read_bytes().startswith(start)
    assert b"Home Calibration" in out.read_bytes()
    assert before == mill.read_bytes()


def test_a_template_that_fails_ends_with_1_and_the_standard_report(amp, mill: Path) -> None:
    (mill.parent / "templates").mkdir()
    (mill.parent / "templates" / "report.html.j2").write_text("{{ report.titel }}")
    refused = amp("report", mill, "-o", mill.with_suffix(".html"), "--without", "motion")
    assert refused.code == 1
    assert "line 1: there is no 'titel' in a Report, did you mean 'title'? The standard report" in refused.err
    assert b"Home Calibration" in mill.with_suffix(".html").read_bytes()


def test_a_report_in_an_unknown_format_is_refused(amp, mill: Path, folder) -> None:
    before = folder()
    assert amp("report", mill, "-o", mill.with_suffix(".doc")).code == 2
    assert amp("report", mill, "-o", mill.with_suffix(".txt"), "--sort", "colour").code == 2
    assert before == folder()


def test_a_simulation_has_the_promised_shape(amp, mill: Path, folder) -> None:
    amp("set", mill, "1030=sercos", "1031=digital")
    before = folder()
    message = amp("simulate", mill, "step", "--axis", "1", "--json")
    assert message.code == (1 if message.json["alarms"] else 0)
    assert {"scenario", "axis", "model", "result", "alarms", "advice", "trace"} <= message.json.keys()
    assert (message.json["scenario"], message.json["axis"]) == ("step", "1")
    assert {"columns", "rows"} <= message.json["trace"].keys()
    assert all({"param", "value", "why"} <= advice.keys() for advice in message.json["advice"])
    assert before == folder()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("juggle",), "juggle"),
        (("step", "--axis", "Q"), "Unknown axis 'Q'. Known: "),
        (("step", "--set", "9999=1"), "Unknown parameter '9999'"),
        (("step", "--set", "1300"), "'1300' is not PARAM=VALUE"),
        (("tap",), "Give move.pitch, as 1 (--pitch)"),
        (
            ("sweep", "--over", "model.delay=1+-0.1"),
            "model.delay has a distribution: say how many samples (--samples)",
        ),
    ],
)
def test_a_simulation_that_cannot_be_is_refused(amp, mill: Path, folder, arguments, message: str) -> None:
    amp("set", mill, "1030=sercos", "1031=digital")
    before = folder()
    refused = amp("simulate", mill, *arguments)
    assert (refused.code, message in refused.err) == (2, True), refused.err
    assert before == folder()


def test_a_recommendation_of_a_simulation_is_what_set_reads(amp, tmp_path: Path) -> None:
    path = tmp_path / "mill.amp"  # of a control with one gain: tests/sim/test_solver.py has several
    path.write_bytes((Path(__file__).parents[2] / "examples/num-1060-mill/MILL_1060.amp").read_bytes())
    advice = amp("simulate", path, "tune", "--for", "stiff", "--json").json["advice"]
    assert advice
    assert advice[0]["price"]
    assert amp("set", path, *(f"{each['param']}={each['value']}" for each in advice)).code == 0
    assert amp("simulate", path, "tune", "--for", "stiff", "--json").json["advice"] == []


def test_a_changed_value_is_drawn_over_the_same_move_with_the_one_of_the_file(
    amp, mill: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    amp("set", mill, "1030=sercos", "1031=digital")
    drawn, write = [], sim.write_trace

    def write_trace(trace: sim.Trace, *where, before: sim.Trace | None, **others) -> None:
        drawn.append((before, trace))
        write(trace, *where, before=before, **others)

    monkeypatch.setattr("amp_studio.sim.write_trace", write_trace)
    changed = ("--set", "servo.initial_gain@1=0.4")
    amp("simulate", mill, "step", "--axis", "1", *changed, "-o", tmp_path / "a.svg")
    ((before, after),) = drawn
    assert before.result["distance"] == after.result["distance"]
    assert before.result["peak_following_error"] != after.result["peak_following_error"]
    assert ">before</text>" in (tmp_path / "a.svg").read_text(encoding="utf-8")
    write(after, tmp_path / "plain.svg", before=None)
    assert ">before</text>" not in (tmp_path / "plain.svg").read_text(encoding="utf-8")


def test_a_parameter_whose_id_begins_like_a_setting_is_tried_by_its_id(amp) -> None:
    """``cam`` is a group of the 57C422B and of settings: by its number the parameter was taken already."""
    press = Path(__file__).parents[2] / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp"
    by_number, by_id = (
        amp("simulate", press, "cam", "--axis", "Y", "--set", f"{name}=25 ms", "--json").json["result"]
        for name in ("R2177", "cam.time@Y")
    )
    assert by_id == by_number
    assert by_id != amp("simulate", press, "cam", "--axis", "Y", "--json").json["result"]
