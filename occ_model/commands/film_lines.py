"""Options and lines of results that the commands share which read films."""

import argparse
import sys
from typing import TypedDict

from occ_model.errors import ParameterError, quote
from occ_model.results.clock import Clock
from occ_model.results.video import Video
from occ_model.results.video_reading import VideoReading
from occ_model.scene.units import Unit
from occ_model.video.known_timing import CRYSTAL_TOLERANCE, MOST_TOLERANCE, READOUT_TOLERANCE

_TOLERANCE = Unit("", spellings=(("ppm", 1e-6),), shown=("%", 1e-2))
_PERCENT = 1e-2


class Tolerances(TypedDict):
    """What is known of a film's clock: the tolerances that :func:`occ_model.decode_video` takes."""

    readout_tolerance: float | None
    frequency_tolerance: float | None


def add_tolerances(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--readout-tolerance",
        metavar="TOLERANCE",
        help="of a film: by how much the readout time may differ from that of the scene, such as "
        f"1%%; default: {100.0 * READOUT_TOLERANCE:g}%% if the frequency is not known either",
    )
    parser.add_argument(
        "--frequency-tolerance",
        metavar="TOLERANCE",
        help="of a film: how well the frequency of the LED is known, such as "
        f"{1e6 * CRYSTAL_TOLERANCE:g}ppm for a crystal, or 2%% for an RC oscillator",
    )


def tolerances_of(options: argparse.Namespace) -> Tolerances:
    return {
        "readout_tolerance": _parse("--readout-tolerance", options.readout_tolerance),
        "frequency_tolerance": _parse("--frequency-tolerance", options.frequency_tolerance),
    }


def _parse(name: str, text: str | None) -> float | None:
    """Parse a tolerance, of which a plain number is in percent."""
    if text is None:
        return None
    tolerance = _TOLERANCE.parse(text, default_factor=_PERCENT)
    if tolerance is None or not 0.0 < tolerance <= MOST_TOLERANCE:
        raise ParameterError.of(
            name, quote(text), f"above 0 % up to {100.0 * MOST_TOLERANCE:g} %, such as 1% or 100ppm"
        )
    return tolerance


def film_channel(name: str) -> str:
    """Return the channel of a film for that of a photo."""
    return "luma" if name == "brightest" else name


def describe_slow_motion(video: Video, clock: Clock | None) -> str:
    """State how slow a film in slow motion is, by its file or by the lamp; empty for others."""
    if video.times.slowdown > 1.0:
        return f"slow motion of 1/{video.times.slowdown:g}, as the file states"
    if clock is not None and clock.slow_motion > 1:
        return f"slow motion of 1/{clock.slow_motion}, as the lamp shows"
    return ""


def print_problems(video: Video, reading: VideoReading) -> None:
    for sentence in (video.problem, *reading.problems, reading.faults, reading.failure):
        if sentence:
            print(sentence, file=sys.stderr)
