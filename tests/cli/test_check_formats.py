"""validate --format: SARIF 2.1.0, GitHub's workflow commands and JUnit's XML have what text and JSON have.

The schema is what the SARIF 2.1.0 standard (OASIS, 27 March 2020) demands of the properties that are written
here; the sections are its own. The whole schema of the standard is not part of the project.
"""

import json
import re
import tomllib
from pathlib import Path
from xml.etree import ElementTree as ET

import jsonschema
import pytest

from amp_studio.cli.checks.formats import CHECK_FORMATS, uri_of
from amp_studio.cli.verbs.checks import validate
from amp_studio.schema.yaml_reader import read_yaml

TEXT = {"type": "string", "minLength": 1}


def closed(required: tuple[str, ...], **properties: object) -> dict[str, object]:
    return {
        "type": "object",
        "additionalProperties": False,
        "required": list(required),
        "properties": properties,
    }


def listed(of: object) -> dict[str, object]:
    return {"type": "array", "items": of}


MESSAGE = closed(("text",), text=TEXT)  # 3.11
LEVEL = {"enum": ["none", "note", "warning", "error"]}  # 3.27.10
PLACE = {
    "physicalLocation": closed(  # 3.29
        ("artifactLocation", "region"),
        artifactLocation=closed(
            ("uri",), uri={**TEXT, "format": "uri-reference", "pattern": r"^[^ \\]+$"}
        ),  # 3.4
        region=closed(("startLine",), startLine={"type": "integer", "minimum": 1}),  # 3.30
    ),
    "logicalLocations": listed(closed((), name=TEXT, fullyQualifiedName=TEXT)),  # 3.33
}
LOCATIONS = listed(closed(("physicalLocation",), **PLACE))  # 3.28
RULE = closed(  # 3.49
    ("id",),
    id=TEXT,
    shortDescription=MESSAGE,
    fullDescription=MESSAGE,
    help=MESSAGE,
    defaultConfiguration=closed(("level",), level=LEVEL),
)
RESULT = closed(  # 3.27
    ("ruleId", "level", "message", "locations"),
    ruleId=TEXT,
    level=LEVEL,
    message=MESSAGE,
    locations=LOCATIONS,
    partialFingerprints={"type": "object", "additionalProperties": TEXT},
    properties={"type": "object"},
    suppressions=listed(
        closed(("kind",), kind={"enum": ["inSource", "external"]}, justification=TEXT)
    ),  # 3.35
)
NOTICE = closed(("message",), level=LEVEL, message=MESSAGE, locations=LOCATIONS)  # 3.58
RUN = closed(  # 3.14
    ("tool",),
    tool=closed(
        ("driver",),
        driver=closed(("name",), name=TEXT, version=TEXT, rules={**listed(RULE), "uniqueItems": True}),
    ),
    invocations=listed(
        closed(
            ("executionSuccessful",),
            executionSuccessful={"type": "boolean"},
            toolExecutionNotifications=listed(NOTICE),
        )
    ),
    results=listed(RESULT),
)
SARIF = closed(  # 3.13
    ("version", "runs"),
    version={"const": "2.1.0"},
    runs=listed(RUN),
    **{"$schema": {**TEXT, "format": "uri"}},
)


@pytest.fixture
def machines(amp, tmp_path: Path, mill: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with a bad machine, a good one and one that cannot be read; the run begins there."""
    amp("set", mill, "1310=1 mm")  # somebody has begun
    amp("set", mill, "1300=1e6", "--force")
    (tmp_path / "bad mill: 100%, old.amp").write_bytes(mill.read_bytes())
    amp("set", mill, "1300=0")
    (tmp_path / "cut.amp").write_bytes(mill.read_bytes()[:-30])
    (tmp_path / "rules.yaml").write_text(
        "suppressions:\n  - {rule: schema.unset, by: M. Weber, reason: new machine}\n", encoding="utf-8"
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def plain(amp, tmp_path: Path) -> Path:
    """Return the path of a file in which nothing is an error: no axis is fitted."""
    path = tmp_path / "plain.amp"
    amp("new", "9pc", path, "--machine", "mill", "--axes", "X")
    assert amp("set", path, "360=unfitted").code == 0
    return path


def run(machines: Path, capsys: pytest.CaptureFixture[str], form: str) -> tuple[int, str, str]:
    from amp_studio import cli

    paths = ["bad mill: 100%, old.amp", "mill.amp", str(machines / "cut.amp")]
    capsys.readouterr()
    code = cli.run(["validate", *paths, "--format", form])
    return code, *capsys.readouterr()


def test_the_formats_of_the_help_are_those_there_are() -> None:
    assert tuple(CHECK_FORMATS) == validate.FORMATS


def test_sarif_has_the_findings_of_json_where_they_are(
    machines: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, _ = run(machines, capsys, "sarif")
    assert code == 2
    found = json.loads(out)
    jsonschema.Draft202012Validator.check_schema(SARIF)
    jsonschema.Draft202012Validator(SARIF).validate(found)
    (one,) = found["runs"]
    files = json.loads(run(machines, capsys, "json")[1])["files"]
    every = [
        (finding["rule"], finding["severity"].replace("advice", "note"))
        for file in files
        if "error" not in file
        for finding in (*file["findings"], *file["suppressed"])
    ]
    assert [(result["ruleId"], result["level"]) for result in one["results"]] == every
    rules = [rule["id"] for rule in one["tool"]["driver"]["rules"]]
    assert rules == sorted({rule for rule, _ in every})
    assert [len(r["suppressions"]) for r in one["results"] if r["ruleId"] == "schema.unset"] == [1, 1]
    first = next(r for r in one["results"] if r["ruleId"] == "schema.range")
    (place,) = first["locations"]
    line = place["physicalLocation"]["region"]["startLine"]
    text = (machines / "bad mill: 100%, old.amp").read_text("utf-8").splitlines()[line - 1]
    assert text.strip() == "home.calibration@1: 1e6 mm" or text.strip().startswith(
        "home.calibration@1: 1000000"
    )
    assert place["physicalLocation"]["artifactLocation"]["uri"] == "bad%20mill%3A%20100%25%2C%20old.amp"
    assert place["logicalLocations"] == [{"name": "1300", "fullyQualifiedName": "home.calibration@1"}]
    assert first["properties"]["fix"] == [{"param": "1300", "value": "999999.99 mm"}]
    (invocation,) = one["invocations"]
    assert invocation["executionSuccessful"] is False
    (notice,) = invocation["toolExecutionNotifications"]
    assert "it has been cut off" in notice["message"]["text"]
    assert notice["locations"][0]["physicalLocation"]["region"]["startLine"] > 1


def test_sarif_has_the_line_of_a_value_in_a_text_of_a_control(amp, tmp_path: Path) -> None:
    listing = [f"${n}=100" for n in (0, 1, 2, 100, 101, 102, 110, 111, 112, 120, 121, 122)]
    path = tmp_path / "mill.txt"
    path.write_text("\n".join(["Grbl 1.1h ['$' for help]", "", *listing, "$20=1", "$22=0"]))
    (one,) = amp("validate", path, "--format", "sarif").json["runs"]
    lines = {
        result["locations"][0]["logicalLocations"][0]["name"]: result["locations"][0]["physicalLocation"][
            "region"
        ]["startLine"]
        for result in one["results"]
    }
    assert {lines[name] for name in ("$20", "$22") if name in lines} <= {15, 16}
    assert lines["$20"] == 15


def test_a_finding_keeps_its_fingerprint_when_the_file_changes_elsewhere(
    amp, machines: Path, mill: Path
) -> None:
    def prints() -> dict[str, str]:
        (one,) = amp("validate", mill, "--format", "sarif").json["runs"]
        return {r["partialFingerprints"]["finding/v1"]: r["ruleId"] for r in one["results"]}

    amp("set", mill, "1300=1e6", "--force")
    before = prints()
    mill.write_text(f"# another first line\n{mill.read_text('utf-8')}", encoding="utf-8")
    amp("set", mill, "1300=2e6", "--force")
    assert (prints(), len(before)) == (before, len(set(before)))
    assert "schema.range" in before.values()


def test_a_file_outside_the_folder_of_the_run_is_named_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    assert uri_of(tmp_path / "a b.amp") == (tmp_path / "a b.amp").as_uri()
    assert uri_of(tmp_path / "here" / "hall" / "a b.amp") == "hall/a%20b.amp"


def test_github_gets_a_command_for_each_finding_and_for_what_cannot_be_read(
    machines: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, err = run(machines, capsys, "github")
    assert code == 2
    commands = [line for line in out.splitlines() if line.startswith("::")]
    severities = [
        finding["severity"]
        for file in json.loads(run(machines, capsys, "json")[1])["files"]
        for finding in file.get("findings", ())
    ]
    kinds = {"error": "::error ", "warning": "::warning ", "advice": "::notice "}
    assert [line.partition("file=")[0] for line in commands] == [*(kinds[s] for s in severities), "::error "]
    first = commands[0]
    assert first.startswith("::error file=bad mill%3A 100%25%2C old.amp,line=")
    assert ",title=schema.range::1300 Home Calibration: " in first
    assert "Suggested fix: 1300 Home Calibration = 999999.99 mm" in first
    assert commands[-1].startswith("::error file=cut.amp,line=")
    assert "\nbad mill: 100%25, old.amp: 9 errors, " in out, "nothing else is taken for a command"
    assert "cut.amp, line " in err


def test_junit_has_a_suite_a_file_and_fails_for_errors_alone(
    machines: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, _ = run(machines, capsys, "junit")
    assert code == 2
    suites = list(ET.fromstring(out))
    assert [suite.get("name") for suite in suites] == [
        "bad mill: 100%, old.amp",
        "mill.amp",
        str(machines / "cut.amp"),
    ]
    for suite in suites:
        cases = suite.findall("testcase")
        counted = {"tests": len(cases)} | {
            f"{name}{'s' if kind != 'skipped' else ''}": len(suite.findall(f"testcase/{kind}"))
            for name, kind in (("failure", "failure"), ("error", "error"), ("skipped", "skipped"))
        }
        assert {name: int(suite.get(name, "")) for name in counted} == counted
        assert all(case.get("classname") == suite.get("name") for case in cases)
    bad, good, unread = suites
    failed = [[case.get("name") for case in suite.findall("testcase[failure]")] for suite in (bad, good)]
    assert failed[0] == ["schema.range 1300", *failed[1]]
    assert (bad.get("failures"), unread.get("errors")) == ("9", "1")
    assert [case.get("name").split()[0] for case in good.findall("testcase[skipped]")] == ["schema.unset"]
    output = bad.findtext("system-out")
    assert "bad mill: 100%, old.amp: 9 errors, " in output
    assert "by M. Weber: new machine" in output


def test_a_machine_without_errors_is_a_case_that_passes(amp, plain: Path) -> None:
    document = amp("validate", plain, "--format", "junit")
    (suite,) = ET.fromstring(document.out)
    assert document.code == 0
    assert [(case.get("name"), list(case)) for case in suite.findall("testcase")] == [("no errors", [])]
    assert [suite.get(name) for name in ("tests", "failures", "errors", "skipped")] == ["1", "0", "0", "0"]


def test_a_letter_that_xml_does_not_have_is_shown(amp, mill: Path, tmp_path: Path) -> None:
    odd = tmp_path / "od\x01d <&\x1b[31m.amp"
    odd.write_bytes(mill.read_bytes())
    (suite,) = ET.fromstring(amp("validate", odd, "--format", "junit").out)
    assert suite.get("name").endswith("od\\u0001d <&\\u001b[31m.amp")


def test_reasons_are_for_text_and_json(amp, mill: Path) -> None:
    assert (
        amp("validate", mill, "--why", "--format", "sarif").err
        == "amp-studio: --why is for the formats text and json\n"
    )


@pytest.mark.parametrize("form", ["json", "sarif", "junit"])
def test_a_terminal_without_utf_8_gets_the_same_document(amp, mill: Path, tmp_path: Path, form: str) -> None:
    named = tmp_path / "Fräse.amp"
    named.write_bytes(mill.read_bytes())
    amp("set", named, "3300=1e9", "--force")  # in degrees
    document = amp("validate", named, "--format", form).out.strip()
    in_ascii = CHECK_FORMATS[form].in_ascii(document)
    assert in_ascii.isascii()
    assert not document.isascii()
    if form == "junit":
        assert ET.canonicalize(in_ascii) == ET.canonicalize(document)
    else:
        assert json.loads(in_ascii) == json.loads(document)


def test_the_hook_of_pre_commit_checks_the_files_of_a_commit(
    checkout: Path, machines: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A hook is what https://pre-commit.com/#new-hooks demands, and its entry is called with file names."""
    from amp_studio import cli

    (hook,) = read_yaml((checkout / ".pre-commit-hooks.yaml").read_text("utf-8")).data
    assert {"id", "name", "entry", "language", "files"} <= hook.keys()
    assert (hook["language"], hook["require_serial"]) == ("python", True)
    staged = sorted(path.name for path in machines.iterdir() if re.search(hook["files"], path.name))
    assert staged == ["bad mill: 100%, old.amp", "cut.amp", "mill.amp"]
    program, *arguments = hook["entry"].split()
    scripts = tomllib.loads((checkout / "pyproject.toml").read_text("utf-8"))["project"]["scripts"]
    assert program in scripts
    assert cli.run([*arguments, staged[0]]) == 1
    assert "1300 Home Calibration" in capsys.readouterr().out


def test_of_several_files_the_name_comes_first_and_of_one_last(amp, tmp_path: Path, checkout: Path) -> None:
    text = (checkout / "examples" / "grblhal-router" / "GRBL_ROUTER.amp").read_text("utf-8")
    for name, speed in (("good.amp", "8000"), ("bad.amp", "-5")):
        (tmp_path / name).write_text(
            text.replace("axis.max_rate@X: 8000", f"axis.max_rate@X: {speed}"), "utf-8"
        )
    alone = amp("validate", tmp_path / "bad.amp").out.splitlines()
    listed = amp("validate", tmp_path, "--no-cache").out.splitlines()
    assert alone[-1].startswith(f"{tmp_path / 'bad.amp'}: 2 errors")
    assert listed == [alone[-1], *(f"  {line}" for line in alone[:-1]), listed[-1]]
    assert listed[-1].startswith(f"{tmp_path / 'good.amp'}: 0 errors")
