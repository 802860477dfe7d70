"""Real listings are read as what they are, come back as they were, and are called wrong only where they
are.
"""

from pathlib import Path
from typing import Any

import pytest

from amp_studio.cli import run
from amp_studio.families.grblhal.settings import addresses_by_number, value_of_text
from amp_studio.files import Change
from amp_studio.formats import export_file, import_file
from amp_studio.schema.yaml_reader import read_yaml
from amp_studio.validate import Validator
from tests.campaigns import some

from .firmware import MAY_BE_ZERO, NO_LIMIT, OF_GRBLHAL, machine_of, refusals

LISTINGS: list[dict[str, Any]] = read_yaml(Path(__file__).with_name("listings.yaml").read_text("utf-8")).data[
    "listings"
]
NAMES = [f"{n} {one['name']}" for n, one in enumerate(LISTINGS, 1)]


def settings_of(one: dict[str, Any]) -> dict[str, str]:
    return dict(each.split("=", 1) for each in one["settings"].split())


@pytest.fixture(params=LISTINGS, ids=NAMES)
def listing(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[dict[str, Any], Path]:
    """Return a listing and the text of it."""
    path = tmp_path / "listing.txt"
    path.write_text("".join(f"${n}={text}\n" for n, text in settings_of(request.param).items()), "utf-8")
    return request.param, path


def test_a_published_listing_is_what_the_firmware_takes_it_for(
    listing: tuple[dict[str, Any], Path], tmp_path: Path
) -> None:
    one, path = listing
    notes: list[str] = []
    file = import_file(path, notify=notes.append)
    assert file.machine == one["machine"]
    assert [f.rule for f in Validator(file).run() if f.severity == "error"] == one["errors"]
    assert sum("kept as text" in note for note in notes) <= 2, "one note for all of a kind"
    again = tmp_path / "again.settings"
    export_file(file, again)
    back = dict(line[1:].split("=", 1) for line in again.read_text("utf-8").splitlines())
    assert {n: same(text, back[n]) for n, text in settings_of(one).items()} == settings_of(one)
    assert back.keys() == settings_of(one).keys(), "nothing is added"


def same(text: str, back: str) -> str:
    """Return the text where the other one is the same: a number may be written with more or fewer zeros."""
    try:
        return text if float(text) == float(back) else back
    except ValueError:
        return back


@pytest.mark.parametrize("listing", some(LISTINGS, 8), indirect=True, ids=some(NAMES, 8))
def test_the_verb_takes_it_without_a_question(listing: tuple[dict[str, Any], Path], tmp_path: Path) -> None:
    _, path = listing
    assert run(["import", str(path), "-o", str(tmp_path / "made.amp")]) == 0


@pytest.mark.parametrize("one", LISTINGS, ids=NAMES)
def test_the_expected_verdict_is_that_of_the_firmware_s_own_rules(one: dict[str, Any]) -> None:
    """Neither the reader nor a rule of ours is asked:
    what the sources of each firmware list and take (firmware.py).
    """
    settings = {int(n): text for n, text in settings_of(one).items()}
    assert one["machine"] == machine_of(settings)
    refused = list(refusals(settings, one["machine"]))
    assert bool(one["errors"]) == bool(refused), refused


def test_what_is_refused_of_a_setting_is_what_the_source_of_grblhal_refuses(tmp_path: Path) -> None:
    """The bounds are those that firmware.py took from settings.c; 0 is allowed beside some of them, and there
    a figure between 0 and the least one is left to the control.
    """
    path = tmp_path / "small.txt"
    axes = " ".join(f"{number}=80" for number in range(100, 108))
    settings = f"0=5.0 1=255 10=511 22=1 {axes} 110=5000 120=500 130=400"
    path.write_text("".join(f"${one}\n" for one in settings.split()), "utf-8")
    file = import_file(path, machine="grblhal")
    known, validator = addresses_by_number(file.machine_schema), Validator(file)
    validator.run()

    def errors(number: int, figure: float) -> list[str]:
        address = known[number]
        before = file.get(address)
        value = value_of_text(file.schema.parameters[address[0]], f"{figure:g}")
        file.apply(Change(address, before, value))
        found = [each.rule for each in validator.update([address]) if each.severity == "error"]
        file.apply(Change(address, value, before))
        validator.update([address])
        return found

    for number, (least, most) in OF_GRBLHAL.items():
        for figure in (least, most):
            assert figure == NO_LIMIT or errors(number, figure) == [], number
        for figure in (most + 1, -1.0 if number in MAY_BE_ZERO else least - 1):
            assert figure == NO_LIMIT or errors(number, figure), f"${number}={figure:g}"


# -- relatives

OF_GRBL = (
    "0=10 1=25 2=0 3=0 4=0 5=0 6=0 10=1 11=0.010 12=0.002 13=0 20=0 21=0 22=0 23=0 24=25 25=500 26=250 27=1"
    " 30=1000 31=0 32=0"
)
OF_AXES = {100: "250.000", 110: "500.000", 120: "10.000", 130: "200.000"}
OF_FLUIDNC = "10=1 20=0 21=1 22=1 23=0 30=24000 32=0"
"""``make_proxies`` and ``make_settings`` of FluidNC: the numbers that its $$ has, beside those of the
axes."""


def listed(settings: str, axes: int) -> str:
    lines = [
        *settings.split(),
        *(f"{first + a}={text}" for first, text in OF_AXES.items() for a in range(axes)),
    ]
    return "".join(f"${line}\n" for line in lines)


@pytest.mark.parametrize(
    ("name", "head", "settings", "axes", "machine"),
    [
        ("Grbl-Mega", "Grbl 1.1g ['$' for help]\n[VER:1.1g.20180813.Mega:]\n", OF_GRBL, 3, "grbl-1.1"),
        ("Grbl-Mega-5X", "Grbl 1.1m ['$' for help]\n", OF_GRBL, 5, "grbl-mega-5x"),
        ("Grbl_ESP32", "Grbl 1.3a ['$' for help]\n", f"{OF_GRBL} 33=5000 34=0 35=0 36=100", 4, "grbl-esp32"),
        ("FluidNC", "Grbl 3.7 [FluidNC v3.7.8 (wifi) '$' for help]\n", OF_FLUIDNC, 4, "grbl-esp32"),
    ],
)
def test_a_listing_of_a_relative_is_read_whole(
    tmp_path: Path, name: str, head: str, settings: str, axes: int, machine: str
) -> None:
    text, again = tmp_path / "listing.txt", tmp_path / "again.settings"
    text.write_text(f"{head}{listed(settings, axes)}ok\n", "utf-8")
    file = import_file(text)
    assert (file.machine, file.unknown) == (machine, {})
    assert [f.rule for f in Validator(file).run() if f.severity == "error"] == []
    export_file(file, again)
    lines = [line for line in again.read_text("utf-8").splitlines() if line.startswith("$")]
    back = dict(line[1:].split("=", 1) for line in lines)
    wanted = dict(line[1:].split("=", 1) for line in listed(settings, axes).splitlines())
    assert {n: same(value, back[n]) for n, value in wanted.items()} == wanted
    assert back.keys() == wanted.keys()
