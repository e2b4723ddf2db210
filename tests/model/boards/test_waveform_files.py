"""The waveform's files: reading them gives the packet with exact times."""

import re
import wave
from fractions import Fraction
from io import BytesIO
from itertools import pairwise, product

import numpy as np
import pytest
from each_case import each_case
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.boards.sketch import BOARDS, board_named
from occ_model.boards.transmission import Transmission, prepare_transmission
from occ_model.boards.waveform_files import (
    HIGHEST_SAMPLE_RATE,
    choose_wav_timing,
    edge_rows,
    format_decimal,
    vcd_text,
    wav_bytes,
)

PAPER = occ.load_preset("phone-68us")

_UNITS = {"s": 0, "ms": 3, "us": 6, "ns": 9, "ps": 12, "fs": 15}


def sent_by(board: str, **changes: float | str) -> Transmission:
    return prepare_transmission(PAPER.replace(**changes), board_named(board))


every_board = pytest.mark.parametrize("board", BOARDS)


LIGHTS: list[dict[str, float | str]] = [
    *(
        {"pattern": pattern, "switching_frequency": frequency}
        for pattern in ("", "0011", "10", "1", "0110")
        for frequency in (100.0, 4e3, 14.7e3)
    ),
    {"light": "lamp", "lamp_frequency": 239.0, "duty": 0.3},
    {"light": "lamp", "lamp_frequency": 100e3, "duty": 0.9},
    {"light": "lamp", "lamp_frequency": 0.5, "duty": 0.01},
    {"light": "pulses", "pulse_frequency": 60.0, "pulse_length": 500e-6},
]


@each_case(product(BOARDS, LIGHTS))
def test_the_value_change_dump_is_the_light_that_is_simulated(
    board: str, light: dict[str, float | str]
) -> None:
    """Integrate the dump's waveform over each column's exposure."""
    sent = sent_by(board, **light)
    text = vcd_text(sent)
    ((number, unit),) = re.findall(r"\$timescale (\d+) (\w+) \$end", text)
    tick = Fraction(int(number), 10 ** _UNITS[unit])
    times = [int(time) * tick for time in re.findall(r"^#(\d+)$", text, re.MULTILINE)]
    levels = [int(level) for level in re.findall(r"^([01])!$", text, re.MULTILINE)]
    rows = list(edge_rows(sent))  # of the table of edges
    assert [row[3] for row in rows[:-1]] == levels
    assert [Fraction(row[1], sent.timing.clock) for row in rows] == times
    assert all(abs(Fraction(row[2]) - time) < 1e-18 for row, time in zip(rows, times, strict=True))
    assert any((time / (10 * tick)).denominator > 1 for time in times)  # no coarser tick would do

    def light_until(time: Fraction) -> Fraction:
        whole, rest = divmod(time, times[-1])
        lit = Fraction(0)
        for (start, end), level in zip(pairwise(times), levels, strict=True):
            lit += level * (whole * (end - start) + min(end, rest) - min(start, rest))
        return lit

    scene = sent.sent_scene.replace(columns=200, start_time=1e-3)
    exposure, readout = Fraction(scene.camera.exposure_time), Fraction(scene.camera.readout_time)
    starts = [Fraction(1e-3) + column * readout for column in range(200)]
    wanted = [float(light_until(start + exposure) - light_until(start)) for start in starts]
    # The scene's floats differ from the exact values by 1e-16 of the time since 0.
    np.testing.assert_allclose(occ.on_time(scene), wanted, atol=1e-12)


@pytest.mark.parametrize(
    ("frequency", "tick", "last"),
    [(1.0, "1 s", 24), (100.0, "10 ms", 24), (4e3, "10 us", 600), (14.7e3, "1 us", 1632)],
)
def test_the_value_change_dump_counts_the_coarsest_ticks(
    frequency: float, tick: str, last: int
) -> None:
    """A viewer samples at each tick: 24 chips of 10 ms are 24 samples, not 2.4e9 of 100 ps."""
    text = vcd_text(sent_by("arduino-uno", switching_frequency=frequency))
    assert f"$timescale {tick} $end" in text
    assert text.endswith(f"\n#{last}\n")


@every_board
@pytest.mark.parametrize("frequency", [1e3, 14.7e3, 40e3])
def test_a_wav_file_holds_whole_packets_with_even_edges(board: str, frequency: float) -> None:
    sent = sent_by(board, switching_frequency=frequency)
    timing = choose_wav_timing(sent)
    with wave.open(BytesIO(wav_bytes(sent))) as file:
        assert (file.getnchannels(), file.getsampwidth()) == (1, 1)
        assert file.getframerate() == timing.sample_rate <= HIGHEST_SAMPLE_RATE
        samples = np.frombuffer(file.readframes(file.getnframes()), dtype=np.uint8)
    chips = samples.reshape(-1, timing.samples)
    assert (chips == chips[:, :1]).all()
    assert len(chips) % len(sent.chips) == 0
    np.testing.assert_array_equal(chips[:, 0], np.resize(sent.chips, len(chips)) * 255)
    assert len(samples) >= timing.sample_rate
    told = Fraction(timing.sample_rate, timing.samples)
    assert told == sent.timing.frequency * (1 + timing.error_ppm / 10**6)
    assert abs(timing.error_ppm) < 10


def test_a_frequency_that_divides_a_usual_rate_gets_it() -> None:
    assert choose_wav_timing(sent_by("arduino-uno", switching_frequency=2e3)).sample_rate == 192_000


def test_a_wav_file_is_refused_if_its_sample_rate_would_be_too_low() -> None:
    with pytest.raises(occ.OutputError) as refused:
        choose_wav_timing(sent_by("esp32", switching_frequency=100e3))
    assert str(refused.value) == (
        "A WAV file has up to 192 kHz, and at least two samples a chip, for up to 96 kHz; the "
        "switching frequency is 100 kHz."
    )


def test_a_wav_file_is_refused_if_it_would_be_too_large() -> None:
    scene = PAPER.replace(payload="bits:" + "01" * 2048, switching_frequency=1.0)
    with pytest.raises(occ.OutputError, match=r"^The waveform takes [\d,]+ samples; allowed"):
        wav_bytes(prepare_transmission(scene, board_named("arduino-uno")))


@settings(max_examples=15)
@given(value=st.fractions(0, 100, max_denominator=10**6))
def test_a_decimal_is_the_number_to_eighteen_places(value: Fraction) -> None:
    assert abs(Fraction(format_decimal(value)) - value) <= Fraction(1, 2 * 10**18)
    assert not format_decimal(value).endswith(".")
