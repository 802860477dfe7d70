"""What was last put into a control from a file, from the record of exchanges and the kept copies."""

import hashlib
import json
from pathlib import Path

import pytest

from amp_studio.files import Document, ParameterFile, new_file
from amp_studio.schema import Value
from amp_studio.transfer.client.kept import digest_path, keep_image
from amp_studio.transfer.client.previous_download import NoDownloadError, last_download
from amp_studio.transfer.client.record import add_exchange, changes_of, exchange_now
from amp_studio.transfer.image import encode_image
from tests.campaigns import some

CALIBRATION = ("home.calibration", "1")


def mill(calibration: float) -> ParameterFile:
    """Return a mill with this home calibration."""
    file = new_file("9pc", "mill", ["X"])
    file.set(CALIBRATION, Value(calibration, "mm"))
    return file


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return the path of a mill on disk."""
    path = tmp_path / "mill.amp"
    Document.create(mill(9.0), path).close()
    return path


def record(path: Path, before: ParameterFile | None, after: ParameterFile) -> Path | None:
    """Record a download of a file, as the program does; returns the copy that was kept."""
    current, sent = (b"" if file is None else encode_image(file) for file in (before, after))
    kept = keep_image(current, path.parent, "mill", readable=False) if current else None
    digests = [hashlib.sha256(image).hexdigest() if image else "" for image in (current, sent)]
    add_exchange(
        path,
        exchange_now(
            "download",
            path,
            "9pc",
            "tcp://cnc:9600",
            before=digests[0],
            after=digests[1],
            state="new",
            kept=str(kept or ""),
            changes=changes_of(current, sent),
        ),
    )
    return kept


def test_the_last_download_is_the_copy_kept_before_it_with_its_changes(path: Path) -> None:
    record(path, mill(0.0), mill(1.0))
    record(path, mill(1.0), mill(2.0))
    found = last_download(mill(9.0), path)
    assert (found.file.get(CALIBRATION), found.control) == (Value(2.0, "mm"), "tcp://cnc:9600")
    assert len(found.file.values) == len(mill(9.0).values)


def test_into_an_empty_control_the_changes_are_all_there_was(path: Path) -> None:
    record(path, None, mill(1.0))
    assert last_download(mill(9.0), path).file.values == mill(1.0).values


def test_a_value_set_after_the_download_was_not_in_it(path: Path) -> None:
    record(path, mill(0.0), mill(1.0))
    file = mill(1.0)
    file.set(("home.calibration", "2"), Value(5.0, "mm"))
    assert last_download(file, path).file.get(("home.calibration", "2")) == mill(1.0).get(
        ("home.calibration", "2")
    )


def test_without_a_record_or_without_the_kept_copy_it_shows_it(path: Path) -> None:
    with pytest.raises(NoDownloadError, match=r"No download of mill\.amp is recorded"):
        last_download(mill(9.0), path)
    kept = record(path, mill(0.0), mill(1.0))
    assert kept is not None
    kept.unlink()
    with pytest.raises(NoDownloadError, match="the copy that was kept before it is not in"):
        last_download(mill(9.0), path)


def test_another_copy_under_the_name_of_the_kept_one_is_not_taken_for_it(path: Path) -> None:
    kept = record(path, mill(0.0), mill(1.0))
    assert kept is not None
    kept.write_bytes(encode_image(mill(7.0)))
    digest_path(kept).unlink()
    with pytest.raises(NoDownloadError, match="the copy that was kept before it is not in"):
        last_download(mill(9.0), path)


@pytest.mark.parametrize(
    "line",
    some(
        [
            {"kept": "/dev/zero"},
            {"kept": "\0"},
            {"kept": "\ud800.img"},
            {"kept": ""},
            {"kept": ".."},
            {
                "changes": [
                    ["home.calibration@99", "", "1 mm"],
                    ["no.such", "", "1"],
                    ["home.calibration@1", "", "much"],
                ]
            },
            {"after": "0" * 64},
        ]
    ),
)
def test_a_damaged_record_counts_as_no_download(path: Path, line: dict[str, object]) -> None:
    record(path, mill(0.0), mill(1.0))
    place = path.with_name("exchanges.jsonl")
    place.write_text(json.dumps(json.loads(place.read_text()) | line) + "\n")
    try:
        found = last_download(mill(9.0), path)
    except NoDownloadError:
        return
    assert set(found.file.values) == set(mill(9.0).values)
