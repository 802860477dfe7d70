"""``get`` by marks: changed, unlike on the axes, with findings, newer than the last download;
together they are all demanded.
"""

import hashlib
from pathlib import Path

from amp_studio.files import digest_of, open_file
from amp_studio.files.notes import set_value_note
from amp_studio.files.storage import save_file
from amp_studio.transfer.client.record import add_exchange, changes_of, exchange_now
from amp_studio.transfer.image import encode_image

EXAMPLE = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


def numbers(message) -> set[str]:
    return {row["param"] for row in message.json["values"]}


def test_changed_values_are_those_that_are_not_the_default(amp, example: Path) -> None:
    every = amp("get", example, "--json").json["values"]
    assert numbers(amp("get", example, "--changed", "--json")) == {
        row["param"] for row in every if not row["default"]
    }


def test_axes_differ_lists_all_axes_of_a_parameter_with_different_values(amp, example: Path) -> None:
    before = numbers(amp("get", example, "--axes-differ", "--json"))
    assert "1735" not in before
    assert amp("set", example, "1735=0.03").code == 0
    assert numbers(amp("get", example, "--axes-differ", "--json")) - before == {
        "1735",
        "2735",
        "3735",
        "4735",
        "5735",
    }


def test_marks_together_are_all_demanded(amp, example: Path) -> None:
    assert amp("set", example, "1740=20", "1750=10").code == 0
    found = numbers(amp("get", example, "--with-findings", "--json"))
    assert "1740" in found or "1750" in found
    assert numbers(amp("get", example, "--with-findings", "--changed", "--json")) <= found


def record_download(path: Path) -> None:
    """Record that a file as it is was downloaded into an empty control."""
    image = encode_image(open_file(path).file)
    add_exchange(
        path,
        exchange_now(
            "download",
            path,
            "9pc",
            "tcp://cnc:9600",
            before="",
            after=hashlib.sha256(image).hexdigest(),
            state="new",
            kept="",
            changes=changes_of(b"", image),
        ),
    )


def test_what_is_newer_than_the_last_download_is_listed(amp, example: Path) -> None:
    record_download(example)
    assert numbers(amp("get", example, "--since-download", "--json")) == set()
    assert amp("set", example, "2750=13", "1735=0.03").code == 0
    assert numbers(amp("get", example, "--since-download", "--json")) == {"2750", "1735"}
    assert amp("set", example, "2750=11").code == 0
    assert numbers(amp("get", example, "--since-download", "--json")) == {"1735"}


def test_values_with_a_note_are_listed(amp, example: Path) -> None:
    document = open_file(example).file
    set_value_note(document, ("servo.excess_error", "2"), "ask Karl")
    save_file(document, example, expected=digest_of(example))
    assert numbers(amp("get", example, "--with-notes", "--json")) == {"2750"}
    assert amp("find", example, "karl").out.splitlines()[0].startswith("note ask Karl: 2750 Excess Error Y")


def test_without_a_download_nothing_can_be_newer_than_it(amp, example: Path) -> None:
    message = amp("get", example, "--since-download")
    assert (message.code, "No download of mill.amp is recorded" in message.err) == (2, True)
