"""Numbers that results compute from their fields: rates, verdicts, means, packets."""

import math
from pathlib import Path

import numpy as np
import pytest
from matches import match_with

import occ_model as occ
from occ_model.results.accuracy import TimeFractions
from occ_model.results.bit_errors import BitErrors
from occ_model.results.photo_table import DOUBTFUL, SURE, CombinedEstimate, PhotoRow, PhotoTable
from occ_model.results.sent_packets import FilmPart, PacketReading, SentPackets
from occ_model.results.video_reading import VideoReading
from occ_model.scene.scene import Scene


@pytest.mark.parametrize("frames_a_second", [1.0, 25.0, 240.0])
def test_net_bits_a_second_lie_within_their_interval(frames_a_second: float) -> None:
    errors = BitErrors("own", 1000, 30, 0.02, 0.05, 100, 90, 0.82, 0.95, 0.01, 0.02)
    low, high = errors.bits_a_second_interval(frames_a_second)
    assert low < errors.bits_a_second(frames_a_second) < high
    assert (low, high) == pytest.approx((8.2 * frames_a_second, 9.5 * frames_a_second))


def test_an_exposure_that_was_not_estimated_has_no_verdict() -> None:
    row = PhotoRow(Path("1.png"), SURE)
    assert row.exposure_verdict == ""
    of_one = PhotoRow(Path("1.png"), SURE, match=match_with())
    assert of_one.exposure_verdict == SURE
    doubted = PhotoRow(Path("1.png"), SURE, match=match_with(exposure_reasons=("Few edges.",)))
    assert doubted.exposure_verdict == DOUBTFUL


@pytest.mark.parametrize(("effect", "differ"), [("flicker", False), ("vignetting", True)])
def test_rows_differ_if_an_effect_acts_on_more_than_columns(effect: str, differ: bool) -> None:
    scene = Scene().replace(rows=40, columns=200, flicker_depth=0.5, vignetting_exponent=4.0)
    off = {d.effect: False for d in occ.plan(scene).decisions}
    frame = occ.render(scene, tolerance=math.inf, force=off | {effect: True})
    assert TimeFractions.of(frame).rows_differ is differ
    assert effect in frame.plan
    assert "jpeg" not in frame.plan


ROWS = tuple(
    PhotoRow(Path(f"{place}.png"), verdict) for place, verdict in enumerate([SURE, DOUBTFUL, SURE])
)


def of(estimated: CombinedEstimate | None) -> list[tuple[bool, bool]]:
    table = PhotoTable(Scene(), "readout_time", ROWS, estimated, None)
    return [(table.is_outlier(place), table.is_counted(place)) for place in range(len(ROWS))]


def test_only_a_sure_photo_is_in_the_mean_or_an_outlier() -> None:
    mean = CombinedEstimate(1e-5, 1e-7, 1, 0.0, 1.0, 1.0, outliers=(2,))
    assert of(mean) == [(False, True), (False, False), (True, False)]


def test_without_a_mean_no_photo_is_in_it_or_an_outlier() -> None:
    assert of(None) == [(False, False)] * 3


@pytest.mark.parametrize(("duration", "rate"), [(0.0, 0.0), (0.25, 160.0), (4.0, 10.0)])
def test_bits_a_second_are_the_bits_read_over_the_films_length(
    duration: float, rate: float
) -> None:
    kinds = [(20, 0), (20, None), (9, 1), (None, None)]
    packets = [
        PacketReading(number, 0, 0.0, 0, 1.0, None if bits is None else np.zeros(bits, np.uint8), w)
        for number, (bits, w) in enumerate(kinds)
    ]
    sent = SentPackets((FilmPart(0.0, duration, len(packets)),), tuple(packets))
    none = np.zeros(0, dtype=np.uint8)
    film = VideoReading((), sent, None, none, none > 0, "", 1.0, None, duration, None)
    assert film.bits_per_second == rate
    assert film.net_bits_per_second == rate / 2.0  # the two right ones are repeats in one frame


_BITS = np.zeros(8, dtype=np.uint8)
_MANY = 15_000_000


def shown(number: int, time: float, frame: int | None = 0) -> PacketReading:
    return PacketReading(number, number % 3, time, frame, 1.0, _BITS, 0)


@pytest.fixture
def packets() -> SentPackets:
    """Make fifteen million packets in two parts, between which the times jump by a day."""
    parts = (
        FilmPart(100.0, 10_000.0, _MANY - 5, begin=1e-3, step=5e-4),
        FilmPart(90_000.0, 1.0, 5, begin=0.0, step=0.2, first_part=(_MANY - 5) % 3),
    )
    in_view = (shown(0, 100.001), shown(7_000, 103.501), shown(_MANY - 2, 90_000.6))
    return SentPackets(parts, in_view, 3)


def test_all_packets_are_counted_and_each_can_be_requested(packets: SentPackets) -> None:
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
    counts = [count for count, _ in packets.cut(np.array([0.0, 1.0, 1e4, 10_000.3, 10_001.0]))]
    assert counts == [1998, _MANY - 5 - 1998, 2, 3]


def test_the_time_of_a_cut_is_that_of_the_part_it_is_in(packets: SentPackets) -> None:
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
