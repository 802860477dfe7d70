"""Single values tuned in a connected Grbl control: what is sent, what comes back,
and what a lost line leaves.
"""

from pathlib import Path

import pytest

from amp_studio.files import RangeError
from amp_studio.schema import Value
from amp_studio.transfer.client.live import LiveTuning
from amp_studio.transfer.client.record import read_exchanges
from amp_studio.transfer.errors import TransferError
from tests.families.grblhal.bench import Bench, current, sent


@pytest.fixture
def live(bench: Bench, tmp_path: Path) -> LiveTuning:
    tuning = LiveTuning(bench.driver, tmp_path / "router", address="bench", record=tmp_path / "router.amp")
    tuning.look()
    return tuning


def test_one_changed_value_is_one_line_and_is_read_back(bench: Bench, live: LiveTuning) -> None:
    assert live.is_live
    assert live.file is not None
    address = live.file.find("$120")
    outcome = live.set({address: Value(25.0, "mm/s2")})
    assert outcome.verified
    assert sent(bench) == ["$120=25.000"]
    assert live.file.values[address].value == 25
    assert [d.address for d in live.changes().differences] == [address]


def test_the_old_values_go_back_after_several_changes(bench: Bench, live: LiveTuning, tmp_path: Path) -> None:
    assert live.file is not None
    first, second = live.file.find("$120"), live.file.find("$130")
    before = current(bench).settings
    for value in (25.0, 30.0):
        live.set({first: Value(value, "mm/s2")})
    live.set({second: Value(250.0, "mm")})
    assert len(live.changes().differences) == 2
    live.put_back()
    assert current(bench).settings == before
    assert not live.changes().differences
    assert len(list(tmp_path.glob("*.img"))) == 1  # what it contained at first, once
    verbs = [(each.verb, len(each.changes)) for each in read_exchanges(tmp_path)]
    assert verbs == [("tune", 1), ("tune", 1), ("tune", 1), ("restore", 2)]


def test_a_value_out_of_range_is_not_sent(bench: Bench, live: LiveTuning) -> None:
    assert live.file is not None
    with pytest.raises(RangeError):
        live.set({live.file.find("$130"): Value(-1.0, "mm")})
    assert sent(bench) == []


def test_after_a_lost_line_nothing_is_taken_for_known_until_it_was_read(
    bench: Bench, live: LiveTuning
) -> None:
    assert live.file is not None
    address = live.file.find("$120")
    answer = bench.spoil_in

    def cut(data: bytes) -> bytes:
        if b"$120=" in data:
            bench.is_cut = True
        return answer(data)

    bench.spoil_in = cut
    with pytest.raises(TransferError) as error:
        live.set({address: Value(25.0, "mm/s2")})
    assert error.value.at_control == "unknown"
    with pytest.raises(TransferError, match="read it again"):
        live.set({address: Value(30.0, "mm/s2")})
    bench.is_cut, bench.spoil_in = False, answer
    live.look()
    assert live.file.values[address].value in (10.0, 25.0)
    assert live.start_file is not None
    assert live.start_file.values[address].value == 10


def test_a_user_else_who_changes_the_control_is_noticed(bench: Bench, live: LiveTuning) -> None:
    assert live.file is not None
    bench.firmware.receive(b"$130=300\n")
    bench.firmware.answer()
    with pytest.raises(TransferError, match=r"something else than what was approved|changed the settings"):
        live.set({live.file.find("$120"): Value(25.0, "mm/s2")})
    assert live.file is None, "the values before are those of nobody now"
    assert live.look().values[live.file.find("$130")].value == 300
