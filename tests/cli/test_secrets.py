"""Secrets: a password in a file is seen by who opens the file itself, and by who asks for it in clear."""

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.files import open_file, secret_values
from amp_studio.formats import formats_of
from amp_studio.schema import family_ids, load_schema
from tests.forked import emulated

SECRET = "7654321"
OTHER = "7654399"
MASK = "•••• (secret)"
WITH_SECRETS = [
    f for f in family_ids() if any(p.secret and not p.optional for p in load_schema(f).parameters.values())
]
"""Families with a secret that is a number in every file."""


def with_password(path: Path, password: str) -> Path:
    """Put a figure that is found nowhere else, and that no password takes, into every secret of a file."""
    file = open_file(path).file
    text = path.read_text("utf-8")
    for parameter_id, instance in secret_values(file):
        entry = re.escape(f"{parameter_id}@{instance}" if instance else parameter_id)
        text, count = re.subn(rf"(?m)^  {entry}: .*$", f"  {parameter_id}@{instance}: '{password}'", text)
        assert count == 1
    path.write_text(text, "utf-8")
    return path


@pytest.fixture(scope="module", params=WITH_SECRETS)
def written(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, bytes]:
    """Return a family that has secrets, and the content of a file of it."""
    path = tmp_path_factory.mktemp("secret") / "machine.amp"
    assert cli.run(["new", request.param, str(path)]) == 0
    return request.param, with_password(path, SECRET).read_bytes()


@pytest.fixture
def machine(written: tuple[str, bytes], tmp_path: Path) -> Path:
    """Return a file of a family that has secrets, with a builder's rule that tries to show them."""
    family, content = written
    path = tmp_path / "machine.amp"
    path.write_bytes(content)
    secret = next(p.id for p in load_schema(family).parameters.values() if p.secret)
    (tmp_path / "rules.yaml").write_text(
        f"""rules:
  - id: own.tell
    title: Tells
    severity: error
    reads: {{all: "{secret}@*"}}
    check: all.size() * 1.0 < all[0]
    message: "{{all}} {{double}} {{code}}"
    values: {{double: all[0] + 0.0, code: "string(all[0])"}}
""",
        "utf-8",
    )
    return path


def test_the_nine_pc_has_a_password_and_its_signature_is_what_it_was() -> None:
    assert "9pc" in WITH_SECRETS
    assert load_schema("9pc").signature.startswith("ce5702f60c5ac7f7"), "files in the field carry it"


@pytest.mark.parametrize(
    "arguments",
    [
        ("get", "FILE"),
        ("get", "FILE", "--all"),
        ("get", "FILE", "--json"),
        ("get", "FILE", "--all", "--json"),
        ("get", "FILE", "NUMBER"),
        ("get", "FILE", "NUMBER", "--json"),
        ("validate", "FILE"),
        ("validate", "FILE", "--why"),
        ("validate", "FILE", "--json"),
        ("validate", "FILE", "--json", "--why"),
        ("validate", "FOLDER", "--json"),
        ("diff", "FILE", "OTHER"),
        ("diff", "OTHER", "FILE", "--json"),
        ("diff", "FILE", "UNSET"),
        ("diff", "UNSET", "FILE", "--json"),
        ("diff", "FILE", "UNREADABLE"),
        ("get", "UNREADABLE"),
        ("set", "UNREADABLE", "NUMBER=66"),
        ("merge", "UNSET", "FILE", "OTHER", "-o", "NEW"),
        ("merge", "UNSET", "FILE", "OTHER", "--dry-run", "--json"),
        ("diff", "FILE", "OTHER", "--base", "UNSET", "--json"),
        ("diff", "FILE", "OTHER", "--base", "UNSET"),
        ("diff", "FILE", "--defaults"),
        ("set", "FILE", "NUMBER=66"),
        ("set", "FILE", "NUMBER=not-set"),
        ("set", "FILE", "NUMBER=1"),
        ("set", "FILE", "NUMBER=7654321x"),
        ("set", "OTHER", "NUMBER=7654321", "--force"),
    ],
    ids=" ".join,
)
def test_no_verb_shows_a_secret(machine: Path, amp, tmp_path: Path, arguments: tuple[str, ...]) -> None:
    file = open_file(machine).file
    first = secret_values(file)[0]
    named = {
        "FILE": machine,
        "FOLDER": tmp_path,
        "NEW": tmp_path / "new.amp",
        "OTHER": tmp_path / "other.amp",
        "UNSET": tmp_path / "unset.amp",
        "UNREADABLE": tmp_path / "unreadable.amp",
    }
    for name in ("OTHER", "UNREADABLE"):
        shutil.copy(machine, named[name])
    with_password(named["OTHER"], OTHER)
    with_password(named["UNREADABLE"], f"x{SECRET}")
    lines = machine.read_text("utf-8").splitlines(keepends=True)
    named["UNSET"].write_text("".join(line for line in lines if SECRET not in line), "utf-8")
    if "FOLDER" in arguments:
        named["UNREADABLE"].unlink()
    number = file.machine_schema.short(first)
    message = amp(*(named.get(a) or a.replace("NUMBER", number) for a in arguments))
    reported = message.out + message.err
    assert SECRET not in reported, reported[
        max(0, reported.index(SECRET) - 200) : reported.index(SECRET) + 50
    ]
    assert OTHER not in reported
    for beside in tmp_path.rglob("*.history"):
        history = beside.read_text("utf-8")
        assert SECRET not in history
        assert OTHER not in history


@pytest.mark.parametrize(
    ("ending", "sort"), [(".html", "axis"), (".csv", "number"), (".txt", "group"), (".pdf", "axis")]
)
def test_no_report_prints_a_secret(
    machine: Path, amp, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str, sort: str
) -> None:
    monkeypatch.setattr(  # all that goes into a PDF, also what is attached to it
        "amp_studio.report.output.pdf.set_pdf", lambda source, options: (f"{source}{options}".encode(), "")
    )
    report = tmp_path / f"report{ending}"  # a secret is a changed value
    assert (
        amp("report", machine, "-o", report, "--sort", sort, "--changed-only", "--without", "motion").code
        == 0
    )
    assert SECRET not in report.read_text("utf-8")
    assert "secret" in report.read_text("utf-8")


def test_no_export_contains_a_secret_and_what_is_masked_comes_back_as_not_set(
    machine: Path, amp, tmp_path: Path
) -> None:
    file = open_file(machine).file
    secret = set(secret_values(file))
    for text_format in formats_of(file.schema.family.family):
        out = tmp_path / f"out{text_format.ending}"
        message = amp("export", machine, "-o", out, "--format", text_format.key)
        assert message.code == 0
        assert "secret values are left out" in message.err
        assert SECRET not in out.read_text(text_format.encoding)
    assert amp("export", machine, "-o", tmp_path / "clear.csv", "--secrets").code == 0
    assert SECRET in (tmp_path / "clear.csv").read_text("utf-8")
    family = file.schema.family.family
    assert amp("report", machine, "-o", tmp_path / "report.csv").code == 0
    for source in ("out.csv", "report.csv"):
        new = tmp_path / f"{source}.amp"
        assert amp("import", tmp_path / source, "-o", new, "--family", family).code == 0
        back = open_file(new).file
        assert secret.isdisjoint(back.values)
        assert back.values.items() <= file.values.items()
        assert len(back.values) > 100


def test_what_is_masked_is_distinguished_from_what_is_not_set(machine: Path, amp, tmp_path: Path) -> None:
    file = open_file(machine).file
    first = file.machine_schema.short(secret_values(file)[0])
    (row,) = amp("get", machine, first, "--json").json["values"]
    assert (row["value"], row["raw"], row["secret"], row["set"]) == (None, None, True, True)
    assert MASK in amp("get", machine, first).out
    (row,) = amp("get", machine, first, "--json", "--secrets").json["values"]
    assert row["value"] == int(SECRET)
    assert amp("set", machine, f"{first}=not-set").code == 0
    (row,) = amp("get", machine, first, "--json").json["values"]
    assert (row["value"], row["secret"], row["set"]) == (None, True, False)


def test_a_difference_of_secrets_is_reported_without_them(machine: Path, amp, tmp_path: Path) -> None:
    other = tmp_path / "other.amp"
    shutil.copy(machine, other)
    with_password(other, OTHER)
    message = amp("diff", machine, other)
    assert message.code == 1
    assert message.out.count(f"{MASK}  |  {MASK}") == len(secret_values(open_file(machine).file))
    assert {
        (d["a"], d["b"], d["secret"]) for d in amp("diff", machine, other, "--json").json["differences"]
    } == {(MASK, MASK, True)}
    assert SECRET in amp("diff", machine, other, "--secrets").out


def test_the_mask_itself_is_no_value(machine: Path, amp) -> None:
    before = machine.read_bytes()
    message = amp("set", machine, f"101={MASK}")
    assert (message.code, "is no value" in message.err) == (2, True)
    assert machine.read_bytes() == before


def test_the_printed_password_is_warned_of_and_not_written(amp, tmp_path: Path) -> None:
    path = tmp_path / "new.amp"
    amp("new", "9pc", path)
    message = amp("validate", path, "--why", "--json").out
    assert "9pc.password.factory-setting" in message
    assert "AB-D4" not in message
    assert "[65" not in message
    assert all(row["default"] for row in amp("get", path, "101", "106", "--json").json["values"])
    amp("set", path, "103=46")  # which five signs are the printed ones is hidden
    rows = amp("get", path, *(str(n) for n in range(101, 107)), "--json").json["values"]
    assert [row["default"] for row in rows] == [False] * 6


@pytest.fixture
def control(tmp_path: Path) -> Iterator[str]:
    """Return the address of an emulated control in a separate process."""
    with emulated("9pc", tmp_path / "control") as (_, address):
        yield address


def test_no_exchange_with_a_control_shows_a_secret(amp, tmp_path: Path, control: str) -> None:
    path = tmp_path / "machine.amp"
    amp("new", "9pc", path)
    amp("set", path, "101=90")
    message = amp("verify", path, "--with", control)
    assert (message.code, message.out.count(f"{MASK}  |  {MASK}")) == (1, 1)
    (difference,) = amp("verify", path, "--with", control, "--json").json["differences"]
    assert (difference["a"], difference["b"]) == (MASK, MASK)
    (difference,) = amp("verify", path, "--with", control, "--json", "--secrets").json["differences"]
    assert (difference["a"], difference["b"]) == ("90", "65")
