"""What ``occ-model decode`` does with a film: read it, frame by frame, and report."""

import argparse
import sys
from collections.abc import Iterator

from occ_model.commands.progress_bar import progress_bar
from occ_model.errors import ParameterError
from occ_model.program import EXIT_FAILURE
from occ_model.results.video import Video
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND
from occ_model.study.reading_facts import clock_facts, error_rate, packet_facts
from occ_model.video.file.source import CHANNELS
from occ_model.video.load import load_video
from occ_model.video.reader import decode_video

_RATE_PARTS = 5  # parts of the film in which error rates are reported
_MIN_RATE_PACKETS = 50  # packets from which the rates of parts are reported


def read_film(options: argparse.Namespace, scene: Scene) -> int:
    """Read the film that a command line names, and print what it says."""
    percent = options.readout_tolerance
    if not 0.0 < percent <= 50.0:
        raise ParameterError.of("--readout-tolerance", f"{percent:g} %", "above 0 % up to 50 %")
    video = load_video(options.file, options.scan_axis, channel=_channel(options.channel))
    with progress_bar(total=video.frame_count, unit="frame", disable=options.follow or None) as bar:

        def report_progress(known: FilmProgress) -> None:
            if options.follow:
                print(_line(known), flush=True)
            else:
                bar.update()

        reading = decode_video(
            video,
            scene,
            options.decoder,
            readout_tolerance=percent / 100.0,
            progress=report_progress,
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
    facts = [*packet_facts(reading), *(() if reading.clock is None else clock_facts(reading.clock))]
    for fact in facts:
        lines.append(f"{fact.label.lower():18}{fact}")
        if fact.key == "packet_error_rate" and len(reading.packets) >= _MIN_RATE_PACKETS:
            lines += _by_parts(reading)
    return lines


def _by_parts(reading: VideoReading) -> Iterator[str]:
    """Write the packet error rate in parts of the film."""
    for window in reading.rates(_RATE_PARTS):
        if window.packets:
            rate = "{} ({})".format(*error_rate(window.packets_lost, window.packets, "packets"))
            yield f"  {SECOND.format(window.start)} to {SECOND.format(window.end)}: {rate}"
