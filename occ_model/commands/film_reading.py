"""What ``occ-model decode`` does with a film: read it, frame by frame, and report."""

import argparse
import sys

from occ_model.commands.progress_bar import progress_bar
from occ_model.errors import ParameterError
from occ_model.program import EXIT_FAILURE
from occ_model.results.video import Video
from occ_model.results.video_reading import Clock, FilmProgress, Measured, VideoReading
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND, Unit
from occ_model.study.confidence import wilson_interval
from occ_model.video.decode import decode_video
from occ_model.video.file.source import CHANNELS
from occ_model.video.load import load_video

_WINDOWS = 5
"""Parts of the film in which error rates are reported."""

_FEWEST_PACKETS = 50
"""Packets from which the rates of parts are reported."""


def read_film(options: argparse.Namespace, scene: Scene) -> int:
    """Read the film that a command line names, and print what it says."""
    video = load_video(options.file, options.scan_axis, channel=_channel(options.channel))
    with progress_bar(total=video.frame_count, unit="frame", disable=options.follow or None) as bar:

        def told(known: FilmProgress) -> None:
            if options.follow:
                print(_line(known), flush=True)
            else:
                bar.update()

        reading = decode_video(
            video,
            scene,
            options.decoder,
            readout_tolerance=options.readout_tolerance / 100.0,
            progress=told,
        )
    for line in _report(reading, video):
        print(line)
    for sentence in (video.problem, *reading.problems):
        if sentence:
            print(sentence, file=sys.stderr)
    if reading.failure is not None:
        print(reading.failure, file=sys.stderr)
        return EXIT_FAILURE
    return 0


def _channel(name: str) -> str:
    """Return a film's channel for that of a photo."""
    if name == "brightest":
        return "luma"
    if name not in CHANNELS:
        raise ParameterError.of(
            "channel", f"'{name}'", f"brightest, {', '.join(CHANNELS)}", condition="for a film"
        )
    return name


def _line(known: FilmProgress) -> str:
    """Say in one line what is known after a frame."""
    frame = known.frame
    what = frame.failure or f"{len(frame.chips)} chips from chip {frame.place} of the packet on"
    payload = f"  {known.payload}" if known.payload else ""
    return (
        f"frame {frame.index:5d}  {SECOND.format(frame.time):>10}  {100.0 * known.known:3.0f} %"
        f"{payload}  ({what})"
    )


def _report(reading: VideoReading, video: Video) -> list[str]:
    placed = sum(frame.place is not None for frame in reading.frames)
    rows, columns = video.shape
    lines = []
    if reading.bits.size:
        lines += [
            f"payload           {reading.payload}",
            f"bits              {''.join(map(str, reading.bits))}",
            f"certainty         {reading.certainty:.4f}",
        ]
    lines.append(
        f"frames            {len(reading.frames)} of {columns} columns, {rows} rows; {placed} of "
        "them placed in the packet"
    )
    if reading.packets:
        lines += _packets(reading)
    if reading.clock is not None:
        lines += _clock(reading.clock)
    return lines


def _packets(reading: VideoReading) -> list[str]:
    sent = len(reading.packets)
    lines = [
        f"packets           {sent} sent, {reading.read} read, {reading.lost} lost, "
        f"{reading.doubled} doubled",
        f"packet error rate {_rate(reading.lost, sent)}",
        f"net bits          {reading.net_bits_per_second:.4g} a second, "
        "repeats within a frame counted once",
    ]
    after = reading.complete_after
    if after is not None:
        lines.append(
            f"complete          after {SECOND.format(after)}: "
            f"{len(reading.bits) / after:.4g} bits a second"
        )
    (whole,) = reading.rates(1)
    if whole.bits:
        lines.append(f"bit error rate    {_rate(whole.bits_wrong, whole.bits)}")
    if sent >= _FEWEST_PACKETS:
        lines += [
            f"  {SECOND.format(window.start)} to {SECOND.format(window.end)}: packet error rate "
            f"{_rate(window.packets_lost, window.packets)}"
            for window in reading.rates(_WINDOWS)
            if window.packets
        ]
    return lines


def _rate(count: int, trials: int) -> str:
    low, high = wilson_interval(count, trials)
    return f"{count / trials:.3g} ({low:.2g} to {high:.2g} at 95 %)"


def _clock(clock: Clock) -> list[str]:
    lines = [
        f"frequency         {_measured(clock.switching_frequency, 'Hz')}",
        f"readout time      {_measured(clock.readout_time, 'µs', 1e6)}",
        f"frame period      {_measured(clock.frame_period, 'ms', 1e3)}",
        f"gap               {_measured(clock.gap, 'ms', 1e3)}, "
        f"{100.0 * clock.gap_ratio:.3g} % of a frame",
    ]
    if clock.drift is not None:
        relative = 1e6 / clock.switching_frequency.value
        lines.append(f"drift             {_measured(clock.drift, 'ppm a second', relative)}")
    lines.append(
        f"frame starts      {SECOND.format(clock.timing_noise)} about their times (root mean "
        f"square of {clock.frames} frames)"
    )
    return lines


def _measured(measured: Measured, unit: str, scale: float = 1.0) -> str:
    return Unit(unit).format_estimate(scale * measured.value, scale * measured.error)
