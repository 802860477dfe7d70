"""Several controls at once, and the record of all exchanges."""

import csv
import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.files import open_file
from amp_studio.transfer.client.fleet import with_each
from amp_studio.transfer.client.record import read_exchanges
from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.exchange import Exchange
from tests.forked import emulated

from .conftest import Outcome

DEAD = "tcp://127.0.0.1:1"
"""Nothing listens there."""


@pytest.fixture
def start_control(tmp_path: Path) -> Iterator[Callable[[], str]]:
    """Return what starts an emulated 9/PC in a separate process and gives its address."""
    with ExitStack() as running:

        def start() -> str:
            state = tmp_path / f"control-{len(list(tmp_path.glob('control-*')))}"
            return running.enter_context(emulated("9pc", state, "--machine", "mill"))[1]

        yield start


def test_a_file_goes_to_several_controls_and_is_verified_in_all(
    amp: Callable[..., Outcome], example: Path, start_control: Callable[[], str]
) -> None:
    one, two = start_control(), start_control()

    sent = amp("download", example, "--to", one, "--to", two, "--json")

    assert sent.code == 0
    assert [(c["address"], c["result"]) for c in sent.json["controls"]] == [(one, "done"), (two, "done")]
    assert len({c["sha256"] for c in sent.json["controls"]}) == 1
    compared = amp("verify", example, "--with", one, "--with", two)
    assert compared.code == 0
    assert [line.split()[:2] for line in compared.out.splitlines()] == [[one, "same"], [two, "same"]]


def test_a_control_that_does_not_answer_is_in_the_table_and_the_others_go_on(
    amp: Callable[..., Outcome], example: Path, start_control: Callable[[], str], tmp_path: Path
) -> None:
    control = start_control()
    table = tmp_path / "results.csv"

    sent = amp("download", example, "--to", DEAD, "--to", control, "--report", table)

    assert sent.code == 3, "one control was changed as wanted, the other was not reached"
    first, second = sent.out.splitlines()
    assert first.split()[:2] == [DEAD, "failed"]
    assert second.split()[:2] == [control, "done"]
    heads, *rows = csv.reader(table.open(encoding="utf-8-sig"))
    assert heads[:2] == ["Address", "Result"]
    assert [row[:2] for row in rows] == [[DEAD, "failed"], [control, "done"]]


def test_after_a_failure_no_other_control_is_begun_where_that_was_asked_for(
    amp: Callable[..., Outcome],
    example: Path,
    start_control: Callable[[], str],
    capsys: pytest.CaptureFixture[str],
) -> None:
    control = start_control()
    before = amp("identify", control, "--json").json["sha256"]
    code = cli.run(["download", str(example), "--to", DEAD, "--to", control, "--stop-on-failure", "--json"])
    printed = capsys.readouterr()
    assert code == 2
    assert [c["result"] for c in json.loads(printed.out)["controls"]] == ["failed", "not tried"]
    assert printed.err.splitlines()[-1].startswith(
        "amp-studio: 0 of 2 controls done; tcp://127.0.0.1:1 failed, "
    )
    assert amp("identify", control, "--json").json["sha256"] == before


def test_an_upload_from_several_controls_writes_a_file_for_each(
    amp: Callable[..., Outcome], example: Path, start_control: Callable[[], str], tmp_path: Path
) -> None:
    one, two = start_control(), start_control()
    amp("download", example, "--to", one, "--to", two)
    folder = tmp_path / "plant"
    folder.mkdir()

    fetched = amp("upload", "--from", one, "--from", two, "-o", folder)

    assert fetched.code == 0
    files = sorted(folder.glob("*.amp"))
    assert [f.name for f in files] == sorted(f"tcp-127.0.0.1-{a.rpartition(':')[2]}.amp" for a in (one, two))
    wanted = dict(open_file(example).file.values)
    assert [dict(open_file(f).file.values) for f in files] == [wanted, wanted]


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (("--to", DEAD, "--to", DEAD), "is named twice"),
        (("--to", DEAD, "--to", "nonsense"), "is no address"),
        (
            ("--to", DEAD, "--to", "tcp://127.0.0.1:2", "--report", "table.doc"),
            "written as .pdf, .html, .xlsx or .csv",
        ),
    ],
)
def test_what_cannot_be_used_is_refused_before_anything_is_begun(
    amp: Callable[..., Outcome],
    example: Path,
    folder: Callable[[], dict[str, bytes]],
    arguments: tuple[str, ...],
    problem: str,
) -> None:
    before = folder()
    refused = amp("download", example, *arguments)
    assert refused.code == 2
    assert problem in refused.err
    assert folder() == before


def test_one_exchange_that_breaks_does_not_end_the_others() -> None:
    def work(address: str, _: Exchange) -> str:
        if address.endswith("1"):
            raise TransferError("the line is cut", "unknown", kept="copy.img")
        if address.endswith("2"):
            raise ZeroDivisionError
        return "well"

    places = [f"tcp://h:{n}" for n in (1, 2, 3)]
    one, two, three = with_each(places, work, lambda _: Exchange(), failed=lambda _: False)

    assert (one.result, one.state, one.kept) == (None, "unknown", "copy.img")
    assert (two.result, two.state) == (None, "unknown")
    assert three.result == "well"


# -- the record ------------------------------------------------------------------


def test_every_exchange_is_recorded_with_what_it_changed_and_is_restored_from(
    amp: Callable[..., Outcome], example: Path, start_control: Callable[[], str]
) -> None:
    control = start_control()
    amp("download", example, "--to", control)
    amp("set", example, "servo.excess_error@1=12 mm")
    amp("download", example, "--to", control)
    amp("verify", example, "--with", control)

    first, second, third = amp("history", example, "--json").json["exchanges"]

    assert [e["verb"] for e in (first, second, third)] == ["download", "download", "verify"]
    assert {e["control"] for e in (first, second, third)} == {control}
    assert second["changes"] == [["servo.excess_error@1", "11 mm", "12 mm"]]
    assert (second["before"], second["after"]) == (first["after"], third["after"])
    assert "servo.excess_error@1" in amp("history", example, "--show", 2).out

    put_back = amp("restore", second["kept"], "--to", control)

    assert put_back.code == 0
    last = amp("history", example, "--json").json["exchanges"][-1]
    assert (last["verb"], last["after"]) == ("restore", first["after"])


def test_a_secret_is_not_in_the_record(
    amp: Callable[..., Outcome], example: Path, start_control: Callable[[], str]
) -> None:
    file = open_file(example).file
    secret = next(p for p in file.schema.parameters.values() if p.secret)
    amp("set", example, f"{secret.id}=GEHEIM")
    amp("download", example, "--to", start_control())
    assert secret.id in (example.parent / "exchanges.jsonl").read_text()
    assert "GEHEIM" not in (example.parent / "exchanges.jsonl").read_text()


def test_an_exchange_that_cannot_be_recorded_has_happened_anyway(
    amp: Callable[..., Outcome], example: Path, start_control: Callable[[], str]
) -> None:
    (example.parent / "exchanges.jsonl").mkdir()
    sent = amp("download", example, "--to", start_control())
    assert sent.code == 0
    assert "could not be recorded" in sent.err


def test_an_exchange_by_a_link_is_one_of_the_file(
    amp: Callable[..., Outcome], example: Path, start_control: Callable[[], str], tmp_path: Path
) -> None:
    link = tmp_path / "here" / "link.amp"
    link.parent.mkdir()
    link.symlink_to(example)
    amp("verify", link, "--with", start_control())
    for path in (example, link):
        assert [e["file"] for e in amp("history", path, "--json").json["exchanges"]] == ["mill.amp"]


def test_the_record_is_no_output(amp: Callable[..., Outcome], example: Path) -> None:
    refused = amp("merge", example, example, example, "-o", example.with_name("exchanges.jsonl"))
    assert refused.code == 2
    assert "choose another name" in refused.err
    assert not (example.parent / "exchanges.jsonl").exists()


def test_an_exchange_that_reached_nothing_is_not_recorded(amp: Callable[..., Outcome], example: Path) -> None:
    assert amp("download", example, "--to", DEAD).code == 2
    assert read_exchanges(example.parent) == []
    assert "No exchange is recorded" in amp("history", example).out


def test_an_exchange_there_is_not_is_refused(amp: Callable[..., Outcome], example: Path) -> None:
    refused = amp("history", example, "--show", 7)
    assert refused.code == 2
    assert "there is no exchange 7" in refused.err
