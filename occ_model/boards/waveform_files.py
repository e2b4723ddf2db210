"""Files of the waveform that a board sends: CSV of its edges, VCD for logic viewers, WAV."""

import wave
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from io import BytesIO
from math import ceil, gcd

import numpy as np

from occ_model.boards.transmission import Transmission
from occ_model.errors import OutputError
from occ_model.scene.units import HERTZ

COLUMNS = ("clock cycles", "time in s", "lit")  # of the table of edges, after the edge's number

# For the VCD file: a cycle of any board's clock is a whole number of the finest ticks. The coarsest
# tick is 1 s; the format allows longer ones, but sigrok takes these as 0 Hz.
_DECIMALS = 10
_TICK_UNITS = ("s", "ms", "us", "ns", "ps")

HIGHEST_SAMPLE_RATE = 192_000  # in Hz, the highest of common sound cards

LOWEST_SAMPLE_RATE = 8_000

_USUAL_RATES = (44_100, 48_000, 96_000, 192_000)

_MAX_RATES = 2_000  # sample rates that are tried, from the highest down
_LARGEST_WAV = 64_000_000  # samples in a file, of one byte each


def edge_rows(transmission: Transmission) -> Iterator[tuple[int, int, str, int]]:
    """Yield the chips at which the light changes, and the ends of the period, with exact times."""
    count = len(transmission.chips)
    edges = sorted({0, *transmission.edges, count})
    for chip in edges:
        cycles = transmission.start_of(chip)
        time = format_decimal(Fraction(cycles, transmission.timing.clock))
        yield chip, cycles, time, int(transmission.chips[chip % count])


def format_decimal(value: Fraction) -> str:
    """Write a number exactly if it has up to 18 decimals, else rounded to these."""
    digits = 18
    scaled = round(value * 10**digits)
    whole, part = divmod(scaled, 10**digits)
    return f"{whole}.{part:0{digits}d}".rstrip("0").rstrip(".")


def vcd_text(transmission: Transmission) -> str:
    """Write one period as a value change dump (IEEE 1364-2005, 18) with exact edges.

    Its tick is the coarsest power of ten of which all edges are multiples, since viewers such as
    sigrok take a sample at each tick.
    """
    rows = list(edge_rows(transmission))
    times = [cycles * (10**_DECIMALS // transmission.timing.clock) for _, cycles, _, _ in rows]
    zeros = next(n for n in range(_DECIMALS, -1, -1) if gcd(*times) % 10**n == 0)
    thousands, tens = divmod(zeros - _DECIMALS, 3)
    lines = [
        f"$comment one {transmission.repeats}, sent repeatedly $end",
        f"$timescale {10**tens} {_TICK_UNITS[-thousands]} $end",
        "$scope module transmitter $end",
        "$var wire 1 ! light $end",
        "$upscope $end",
        "$enddefinitions $end",
    ]
    for time, (chip, _, _, lit) in zip(times, rows, strict=True):
        change = [] if chip == len(transmission.chips) else [f"{lit}!"]
        lines += [f"#{time // 10**zeros}", *change]
    return "\n".join(lines) + "\n"


@dataclass(frozen=True, slots=True)
class WavTiming:
    """Sample rate in Hz and samples in each chip, or a lamp's period, and the frequency's error."""

    sample_rate: int
    samples: int
    error_ppm: Fraction


def choose_wav_timing(transmission: Transmission) -> WavTiming:
    """Choose a WAV file's sample rate so that each chip, or period, has equally many samples.

    It is the whole number of Hz that gives the nearest frequency; common rates are preferred.
    """
    frequency = transmission.timing.frequency
    fewest = max(2, ceil(LOWEST_SAMPLE_RATE / frequency))
    most = int(HIGHEST_SAMPLE_RATE / frequency)
    if most < fewest:
        raise OutputError(
            f"A WAV file has up to {HERTZ.format(HIGHEST_SAMPLE_RATE)}, and at least two samples a "
            f"{transmission.unit}, for up to {HERTZ.format(HIGHEST_SAMPLE_RATE / 2)}; the "
            f"{transmission.frequency} is {HERTZ.format(float(frequency))}."
        )
    sample_counts = range(max(fewest, most - _MAX_RATES), most + 1)
    rates = {each: min(round(frequency * each), HIGHEST_SAMPLE_RATE) for each in sample_counts}
    timings = (
        WavTiming(rate, samples, (Fraction(rate, samples) / frequency - 1) * 10**6)
        for samples, rate in rates.items()
    )
    return min(
        timings,
        key=lambda timing: (
            abs(timing.error_ppm),
            timing.sample_rate not in _USUAL_RATES,
            -timing.sample_rate,
        ),
    )


def wav_bytes(transmission: Transmission) -> bytes:
    """Write whole periods of at least one second as a WAV file of 8 bits; 255 is lit, 0 is dark."""
    timing = choose_wav_timing(transmission)
    samples = transmission.samples(timing.samples) * np.uint8(255)
    periods = ceil(timing.sample_rate / len(samples))
    if periods * len(samples) > _LARGEST_WAV:
        raise OutputError(
            f"The waveform takes {periods * len(samples):,} samples; allowed in a WAV file: "
            f"{_LARGEST_WAV:,}. Raise the switching frequency or send fewer bits."
        )
    buffer = BytesIO()
    with wave.open(buffer, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(1)
        file.setframerate(timing.sample_rate)
        file.writeframes(samples.tobytes() * periods)
    return buffer.getvalue()
