"""Packets are counted without a list of them: millions are sent of which frames show a few."""

import numpy as np
import pytest

from occ_model.results.sent_packets import FilmPart, PacketReading, SentPackets

_BITS = np.zeros(8, dtype=np.uint8)
_MANY = 15_000_000


def shown(number: int, time: float, frame: int | None = 0) -> PacketReading:
    return PacketReading(number, number % 3, time, frame, 1.0, _BITS, 0)


@pytest.fixture
def packets() -> SentPackets:
    """Fifteen million packets in two parts, between which the times jump by a day."""
    parts = (
        FilmPart(100.0, 10_000.0, _MANY - 5, begin=1e-3, step=5e-4),
        FilmPart(90_000.0, 1.0, 5, begin=0.0, step=0.2, first_part=(_MANY - 5) % 3),
    )
    in_view = (shown(0, 100.001), shown(7_000, 103.501), shown(_MANY - 2, 90_000.6))
    return SentPackets(parts, in_view, 3)


def test_all_are_counted_and_each_can_be_asked_for(packets: SentPackets) -> None:
    assert len(packets) == _MANY
    assert packets[7_000].is_right
    between = packets[1_000_000]
    assert (between.number, between.part, between.frame, between.seen) == (1_000_000, 1, None, 0.0)
    assert between.time == pytest.approx(600.001)
    assert packets[-1].time == pytest.approx(90_000.8)
    assert [one.time for one in packets[_MANY - 6 : _MANY - 4]] == pytest.approx(
        [100.001 + 5e-4 * (_MANY - 6), 90_000.0]
    )
    with pytest.raises(IndexError):
        packets[_MANY]


def test_a_cut_counts_each_packet_once(packets: SentPackets) -> None:
    for windows in (1, 2, 7, 1000):
        found = packets.cut(10_001.0 * np.arange(windows + 1) / windows)
        assert sum(count for count, _ in found) == _MANY
        assert [one.number for _, shown in found for one in shown] == [0, 7_000, _MANY - 2]


def test_the_time_of_a_cut_is_that_of_the_part_it_lies_in(packets: SentPackets) -> None:
    assert packets.time_at(0.0) == 100.0
    assert packets.time_at(10_000.0) == 90_000.0
    assert packets.time_at(10_000.0, is_end=True) == 10_100.0
    assert packets.time_at(10_001.0, is_end=True) == 90_001.0


def test_starts_and_steps_are_those_of_the_packets(packets: SentPackets) -> None:
    numbers = np.array([0, 7_000, 1_000_000, _MANY - 6, _MANY - 5, _MANY - 1])
    assert packets.starts(numbers).tolist() == pytest.approx(
        [packets[number].time for number in numbers.tolist()]
    )
    assert packets.steps(numbers).tolist() == [5e-4] * 4 + [0.2] * 2
