"""The command ``occ-model match`` with a film: measure a camera or a lamp by its clock."""

import argparse

from occ_model.commands.bars import progress_bar
from occ_model.commands.film_lines import (
    Tolerances,
    describe_slow_motion,
    film_channel,
    print_problems,
    tolerances_of,
)
from occ_model.errors import ParameterError
from occ_model.program import EXIT_FAILURE
from occ_model.results.clock import Clock
from occ_model.scene.scene import Scene
from occ_model.study.reading_facts import clock_facts
from occ_model.video.decode_film import decode_video
from occ_model.video.known_timing import CRYSTAL_TOLERANCE
from occ_model.video.load import load_video

_WIDTH = 18
_FIRST = {"readout_time": "readout_time", "switching_frequency": "frequency"}


def match_film(options: argparse.Namespace, scene: Scene) -> int:
    """Measure what a film's clock tells, and print it, with the estimated value first."""
    for name in ("lamps", "chips", "region", "fit_gamma", "out"):
        if getattr(options, name):
            option = f"--{name.replace('_', '-')}"
            raise ParameterError(f"{option} is given with a film; allowed: with a photo.")
    video = load_video(options.file, options.scan_axis, channel=film_channel(options.channel))
    with progress_bar(total=video.frame_count, unit="frame", leave=False) as bar:
        reading = decode_video(
            video, scene, progress=lambda _progress: bar.update(), **_known(options)
        )
    if reading.clock is not None:
        slow_motion = describe_slow_motion(video, reading.clock)
        lines = _clock_lines(reading.clock, _FIRST[options.estimate])
        print("\n".join([f"{lines[0]}; {slow_motion}" if slow_motion else lines[0], *lines[1:]]))
    print_problems(video, reading)
    # A raw pattern has no packets, but a clock.
    is_as_stated = reading.failure is None or bool(scene.transmitter.pattern)
    return 0 if reading.clock is not None and is_as_stated else EXIT_FAILURE


def _known(options: argparse.Namespace) -> Tolerances:
    tolerances = tolerances_of(options)
    if options.estimate == "readout_time" and tolerances["frequency_tolerance"] is None:
        tolerances["frequency_tolerance"] = CRYSTAL_TOLERANCE
    return tolerances


def _clock_lines(clock: Clock, first: str) -> list[str]:
    facts = sorted(clock_facts(clock), key=lambda fact: fact.key != first)
    lines = [f"{fact.label.lower():{_WIDTH}}{fact}" for fact in facts]
    return [*lines, f"{'frames':{_WIDTH}}{clock.frames}"]
