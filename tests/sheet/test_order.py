"""The order of a sheet: no state in between breaks a rule that neither its beginning nor its end breaks."""

import random
from pathlib import Path

import pytest

from amp_studio.files import examples_folder, new_file, open_file
from amp_studio.schema import Value
from amp_studio.sheet import Sheet, make_sheet, order
from amp_studio.sheet.order import safe_order
from amp_studio.validate import read_builder_rules
from amp_studio.validate.interim import Interim, NewValue
from tests.campaigns import some
from tests.work import calls_of


def broken_on_the_way(present, sheet, wanted) -> list[set]:
    """Walk a sheet as a person would and return what each step newly breaks."""
    walk = Interim(present)
    return [set(walk.set(NewValue(entry.address, wanted.get(entry.address)))) for entry in sheet.entries]


def test_following_error_limits_that_grow_are_keyed_in_from_the_outermost(present, changed) -> None:
    wanted = changed({"1735": "20 mm", "1730": "60 mm", "1740": "80 mm", "1750": "90 mm"})
    sheet = make_sheet(wanted, present)
    assert [entry.number for entry in sheet.entries] == ["1750", "1740", "1730", "1735"]  # page 7-20
    assert broken_on_the_way(present, sheet, wanted) == [set()] * 4


def test_following_error_limits_that_shrink_are_keyed_in_from_the_innermost(present, changed) -> None:
    wide = changed({"1735": "20 mm", "1730": "60 mm", "1740": "80 mm", "1750": "90 mm"})
    sheet = make_sheet(present, wide)
    assert [entry.number for entry in sheet.entries] == ["1735", "1730", "1740", "1750"]
    assert broken_on_the_way(wide, sheet, present) == [set()] * 4


def test_an_entry_that_waits_for_another_shows_what_it_would_break_and_the_page(present, changed) -> None:
    wide = changed({"1730": "60 mm", "1740": "80 mm", "1750": "90 mm"})
    (waiting,) = [e for e in make_sheet(present, wide).entries if e.number == "1750"]
    assert waiting.order.startswith(
        "After 1740, or else: Feedrate Suppression Point 80 mm is above Excess Error"
    )
    assert waiting.order.endswith("(page 7-21)")


def test_what_narrows_comes_before_what_opens_and_speed_comes_last(present, changed) -> None:
    slower, faster = ("feedrate.max_cutting", "1"), ("feedrate.max_cutting", "2")
    wanted = changed({"3750": "150 mm"})
    for address, factor in ((slower, 0.9), (faster, 1.01)):
        old = present.get(address)
        wanted.set(address, Value(old.value * factor, old.unit))
    sheet = make_sheet(wanted, present)
    assert [e.address for e in sheet.entries] == [slower, ("servo.excess_error", "3"), faster]
    assert [sheet.stages[e.stage].page for e in sheet.entries] == ["7-20", "7-20", "37-1"]


@pytest.mark.parametrize("seed", some(range(12)))
def test_whatever_order_it_starts_from_a_chain_of_limits_finds_the_one_that_breaks_nothing(
    present, changed, seed: int
) -> None:
    chance = random.Random(seed)
    texts = {}
    for axis in "123":
        low, top = chance.choice([(1, 40), (10, 90)])
        for number, part in zip(("735", "730", "740", "750"), (0.01, 0.5, 0.8, 1.0), strict=True):
            texts[axis + number] = f"{low + (top - low) * part} mm"
    wanted = changed(texts)
    final = set(Interim(wanted).broken)
    steps = [NewValue(wanted.find(n), wanted.get(wanted.find(n))) for n in texts]
    chance.shuffle(steps)
    walk = Interim(present)
    order = safe_order(walk, steps, final)
    assert sorted(map(repr, order)) == sorted(map(repr, steps))
    assert [key for step in order for key in walk.set(step) if key not in final] == []


def test_the_search_leaves_the_file_that_it_tries_on_as_it_was(present, changed) -> None:
    wanted = changed({"1730": "60 mm", "1740": "80 mm", "1750": "90 mm"})
    walk = Interim(present)
    safe_order(
        walk, [NewValue(wanted.find(n), wanted.get(wanted.find(n))) for n in ("1730", "1740", "1750")], ()
    )
    assert walk.file.values == present.values


def own_rules(folder: Path, schema, checks: list[str]):
    """Return a builder's rules over three retracts (a, b, c), each an error where it is not so."""
    rules = "\n".join(
        f"""  - id: own.rule-{n}
    title: Rule {n}
    severity: error
    reads: {{a: cycle.peck_retract, b: cycle.clearance, c: cycle.grooving_retract}}
    check: "{check}"
    message: "rule {n}: {{a}} {{b}} {{c}}"
"""
        for n, check in enumerate(checks)
    )
    path = folder / "rules.yaml"
    path.write_text(f"rules:\n{rules}", encoding="utf-8")
    return read_builder_rules(path, schema)


RETRACTS = {"71": "9 mm", "76": "9 mm", "113": "9 mm"}
SMALL = {"71": "1 mm", "76": "1 mm", "113": "1 mm"}


def test_an_order_is_found_where_the_first_step_that_seems_free_leads_nowhere(
    lathe, changed, tmp_path
) -> None:
    """a alone is sound, and after it neither b nor c: only b, c, a and c, b, a are."""
    own = own_rules(
        tmp_path, lathe.schema, ["!(a > 8.0 && b > 8.0 && c < 8.0)", "!(a > 8.0 && c > 8.0 && b < 8.0)"]
    )
    sheet = make_sheet(changed(RETRACTS, lathe), changed(SMALL, lathe), own=own)
    assert [entry.number for entry in sheet.entries] == ["76", "113", "71"]
    assert [entry.until for entry in sheet.entries] == [(), (), ()]


def test_where_no_order_is_sound_the_sheet_shows_what_is_broken_until_which_step(
    lathe, changed, tmp_path
) -> None:
    own = own_rules(tmp_path, lathe.schema, ["a == b && b == c"])
    sheet = make_sheet(changed(RETRACTS, lathe), changed(SMALL, lathe), own=own)
    assert [entry.number for entry in sheet.entries] == ["71", "76", "113"]
    assert [until.partition(" (")[0] for entry in sheet.entries for until in entry.until] == [
        "Until step 3: rule 0: 9 mm 1 mm 1 mm"
    ]


def test_an_error_that_is_there_in_the_end_anyway_is_reported_before_the_work_begins(
    lathe, changed, tmp_path
) -> None:
    own = own_rules(tmp_path, lathe.schema, ["a < 8.0"])
    sheet = make_sheet(changed(RETRACTS, lathe), lathe, own=own)
    assert [warning.partition(" (")[0] for warning in sheet.warnings] == [
        "Error when all is keyed in: rule 0: 9 mm 9 mm 9 mm"
    ]


def test_rules_that_cannot_be_read_are_reported_too(lathe, tmp_path) -> None:
    (warning,) = make_sheet(lathe.copy(), lathe, own=own_rules(tmp_path, lathe.schema, ["a <"])).warnings
    assert "own.rule-0: check: a value is missing" in warning


def test_a_sheet_of_all_values_of_a_large_file_is_made_in_few_steps(present, changed) -> None:
    wanted = present.copy()
    for address, value in present.values.items():
        if isinstance(value.value, float):
            wanted.set(address, Value(value.value * 1.01 + 0.01, value.unit))
    sheets: list[Sheet] = []
    assert calls_of(lambda: sheets.append(make_sheet(wanted, present))) < 3_000_000
    assert len(sheets[0].entries) > 200


def test_values_that_cannot_be_ordered_come_as_they_are_given_after_a_bounded_search(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A search of every order of these 60 values would look at thousands of states for each of them."""
    file = open_file(examples_folder() / "57c422b-label-press" / "LABEL_PRESS.amp").file
    empty = file.copy()
    empty.values.clear()
    steps = [NewValue(address, value) for address, value in list(file.values.items())[:60]]
    start, asked = Interim(empty), list[NewValue]()
    kept = start.set
    monkeypatch.setattr(start, "set", lambda step: (asked.append(step), kept(step))[1])
    monkeypatch.setattr(start, "checks_of", lambda _address: frozenset({"all"}))
    monkeypatch.setattr(order, "bad", lambda *_: ["something"])
    monkeypatch.setattr(order, "_TRIES", 100)
    assert sorted(safe_order(start, steps, ()), key=str) == sorted(steps, key=str)
    assert len(asked) < 1_000


def test_a_search_asks_a_bounded_number_of_checks_also_where_a_value_decides_about_thousands(
    monkeypatch,
) -> None:
    mill = open_file(examples_folder() / "num-1060-mill" / "MILL_1060.amp").file
    asked = []
    plain = Interim.set
    monkeypatch.setattr(
        Interim, "set", lambda i, step: asked.append(i.effort(step.address)) or plain(i, step)
    )
    sheet = make_sheet(mill, new_file("num", mill.machine, ()))
    assert len(sheet.entries) == 390
    assert sum(asked) < 2_000_000, "11 million, or ten seconds, where every state counts the same"
