"""Packets that films carry, compared with exact counting."""

from fractions import Fraction
from pathlib import Path

import pytest

from occ_model.cli import main
from occ_model.study.film_study import (
    FRAME_PERIOD,
    PACKET_CHIPS,
    ShutterTiming,
    example_request,
    film_study,
    mean_packets_received,
    published_rule,
)

TIMING = ShutterTiming(Fraction(8000), Fraction(0), Fraction(1, 40_000), 0, 1000)
"""A view of 25 ms: 200 chips."""


def packets_received(
    timing: ShutterTiming, frame_period: Fraction, length: int, start: Fraction
) -> Fraction:
    """Return the exact fraction of packets that an endless film shows whole.

    The starts of frames within a packet repeat after b frames, with f T / length = a / b.

    ``frame_period``: t in seconds. ``start``: when the first frame starts, in seconds.
    """
    packets_a_frame = timing.frequency * frame_period / length
    frames = packets_a_frame.denominator
    whole = sum(
        timing.whole_packets(start + number * frame_period, length) for number in range(frames)
    )
    return Fraction(whole) / (frames * packets_a_frame)


def test_a_view_of_whole_chips_shows_them_all_and_no_more() -> None:
    assert TIMING.whole_chips(Fraction(0)) == (0, 200)
    assert TIMING.whole_chips(Fraction(1, 16_000)) == (1, 200)
    assert TIMING.whole_packets(Fraction(0), 50) == 4
    assert TIMING.whole_packets(Fraction(1, 8000), 50) == 3
    assert TIMING.whole_packets(Fraction(1, 8000), 201) == 0


def test_counting_over_all_starts_gives_the_mean_over_the_start_time() -> None:
    period = Fraction(1, 30)
    by_start = [
        packets_received(TIMING, period, 50, Fraction(start, 8000 * 30)) for start in range(50 * 30)
    ]
    mean = sum(by_start, Fraction(0)) / len(by_start)
    # A start at the edge of a chip shows it whole, so steps of 1/30 chip count it once more.
    assert float(mean) == pytest.approx(float(mean_packets_received(TIMING, period, 50)), abs=1e-3)


def test_a_frame_shows_the_chips_whole_that_are_not_cut_off() -> None:
    assert TIMING.whole_chips(Fraction(0)) == (0, 200)
    # The second frame starts with chip 266 2/3.
    assert TIMING.whole_chips(Fraction(1, 30)) == (267, 466)


def test_the_published_example_is_received_as_counted() -> None:
    request = example_request(frames=33)
    (point,) = film_study(request)
    assert point.packet_chips == PACKET_CHIPS == 52
    assert point.is_right
    assert point.reception == pytest.approx(point.counted_reception, abs=0.02)
    # By hand: (26.64 ms - 6.5 ms) / 33.3 ms on average over the start time.
    by_hand = (Fraction(8, 10) * FRAME_PERIOD - Fraction(PACKET_CHIPS, 8000)) / FRAME_PERIOD
    # The exposure of 25 us exceeds the readout time by a hundred-thousandth of a frame.
    assert point.on_average == pytest.approx(float(by_hand), abs=2e-5)
    assert point.reception == pytest.approx(float(by_hand), abs=0.02)


def test_the_rule_of_the_published_simulator_is_within_two_points_of_counting() -> None:
    # 270 - 65 of 333 steps of 0.1 ms, of which one in a hundred is lost.
    assert published_rule() == Fraction(205, 333) * Fraction(99, 100)
    by_hand = (Fraction(8, 10) * FRAME_PERIOD - Fraction(PACKET_CHIPS, 8000)) / FRAME_PERIOD
    assert abs(float(published_rule() - by_hand)) < 0.02


@pytest.mark.usefixtures("plain_figures")
def test_the_command_writes_the_numbers_that_it_prints(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("occ_model.figures.drawing.ENDINGS", (".png", ".csv"))
    out = tmp_path / "films"
    assert main(["film-study", "--frequencies", "8kHz", "--gaps", "20", "--bits", "16",
                 "--frames", "6", "--set", "framing=preamble", "--set", "line_code=manchester",
                 "--set", "exposure_time=40us", "--out", str(out)]) == 0  # fmt: skip
    printed = capsys.readouterr().out.splitlines()[1].split()
    rows = [line for line in (out / "films.csv").read_text().splitlines() if line[0] != "#"]
    values = dict(zip(rows[0].split(","), rows[1].split(","), strict=True))
    assert printed[0] == "8"
    assert values["payload (bits)"] == "16"
    assert values["packets sent"] in printed
    assert (out / "films.png").stat().st_size > 1000
