"""The command ``occ-model decode``: read the code from a picture, a photo or a film."""

import argparse
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from occ_model.arrays import ByteArray
from occ_model.commands.bars import progress_bar
from occ_model.commands.film_lines import (
    Tolerances,
    add_tolerances,
    describe_slow_motion,
    film_channel,
    print_problems,
    tolerances_of,
)
from occ_model.commands.options import (
    Commands,
    add_option,
    add_scene_options,
    decoder_name,
    scene_of,
)
from occ_model.errors import ParameterError, inflect, one_line
from occ_model.files.reading import is_film
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.colours import ColourPhoto, load_colours
from occ_model.photo.reading.load import load_photo
from occ_model.program import EXIT_FAILURE
from occ_model.receiver.colour import decode_colours, measure_mixing
from occ_model.receiver.decode import DECODERS, decode
from occ_model.receiver.signal import white_fraction
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, overexposed_text
from occ_model.results.video import Video
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.colour_scenes import check_monochrome, is_colour
from occ_model.scene.light_words import describe_light
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND
from occ_model.study.cause.cause import cause_of
from occ_model.study.reading_facts import clock_facts, error_rate, packet_facts
from occ_model.transmitter.scheme import check_code
from occ_model.video.colour import decode_colour_video
from occ_model.video.decode_film import decode_video
from occ_model.video.load import load_video


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("decode", help="read the code from a picture, photo or film")
    parser.add_argument("file", type=Path, help="picture or film")
    add_scene_options(parser)
    parser.add_argument(
        "--decoder",
        type=decoder_name,
        default=PAPER_DECODER,
        help=f"one of {', '.join(DECODERS)} or a plug-in's; default: %(default)s",
    )
    scanned = "what the shutter scans in the file; auto: across the stripes"
    add_option(parser, "--scan-axis", SCAN_AXES[0], scanned, choices=SCAN_AXES)
    channel = (
        "the channel of a coloured photo to read; brightest: the colour with the largest mean, or "
        "luma in a film, of which red, green or blue can be read, too"
    )
    add_option(parser, "--channel", CHANNELS[0], channel, choices=CHANNELS)
    parser.add_argument(
        "--follow", action="store_true", help="for a film: print what is known after each frame"
    )
    parser.add_argument(
        "--calibration", type=Path, nargs=4, metavar=("RED", "GREEN", "BLUE", "DARK"),
        help="of a colour camera: pictures with one LED steadily lit, and with none, by which "
        "the mixing matrix is measured",
    )  # fmt: skip
    add_tolerances(parser)
    parser.add_argument(
        "--offset-to",
        type=Path,
        metavar="FILM",
        help="for a film: another film of the same LED, whose times are compared with those of "
        "this one",
    )
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options, may_have_colours=True)
    if is_colour(scene):
        return _read_colours(options, scene)
    check_monochrome(scene)
    if options.calibration:
        raise ParameterError("--calibration is for a colour camera; set bayer, such as bayer=rggb.")
    check_code(scene.transmitter, instead="match its picture")
    tolerances = tolerances_of(options)
    if options.follow or is_film(options.file):
        return read_film(options, scene, tolerances)
    result, image = _decode_picture(scene, options, options.scan_axis)
    for line in _report_lines(result):
        print(line)
    for sentence in _remarks(result, image, scene):
        print(sentence, file=sys.stderr)
    return 0 if result.failure is None else EXIT_FAILURE


def _read_colours(options: argparse.Namespace, scene: Scene) -> int:
    """Read the three colours of a picture, and print one line with all of them first."""
    if options.channel != "brightest":
        raise ParameterError("--channel is for a scene of one LED; --colour reads one of three.")
    if options.follow or is_film(options.file):
        if options.calibration or options.offset_to:
            raise ParameterError(
                "--calibration is for a picture, and --offset-to for a film of one LED."
            )
        return read_film(options, scene, tolerances_of(options))

    def load(path: Path) -> ColourPhoto:
        return load_colours(path, gamma=scene.camera.gamma, scan_axis=options.scan_axis)

    photo = load(options.file)
    if photo.bayer:
        scene = scene.replace(bayer=photo.bayer)
    if options.calibration:
        scene = measure_mixing([load(path).image for path in options.calibration], scene)
        print(f"mixing       {scene.colours.mixing}")
    reading = decode_colours(photo.image, scene, options.decoder)
    print(f"colours      {reading}")
    if reading.region is not None:
        print(f"region       {reading.region}")
    for colour, result in reading.by_colour.items():
        if result.failure is not None:
            print(f"{colour}: {result.failure}", file=sys.stderr)
    return 0 if reading.is_read else EXIT_FAILURE


def _remarks(result: DecodeResult, image: ByteArray, scene: Scene) -> list[str]:
    """State why nothing was read, and overexposure, which comes first if it is the cause."""
    failure = [] if result.failure is None else [result.failure]
    if result.region is None:
        return failure
    white = white_fraction(image, result.region, is_enhanced=scene.model.enhancement != "none")
    # The picture need not be of this scene; only its own pixels are certain.
    cause = cause_of(scene, result.decoder) if failure and white != 0.0 else None
    if cause is not None and cause.is_overexposed:
        return [str(cause), *failure]
    return [*failure, overexposed_text(white)] if white else failure


def _decode_picture(
    scene: Scene, options: argparse.Namespace, scan_axis: str
) -> tuple[DecodeResult, ByteArray]:
    """Read a picture; one of the scene's size without a code is also tried as it is stored."""
    image = load_photo(options.file, scan_axis, channel=options.channel).image
    result = decode(image, scene, options.decoder)
    rows, columns = scene.camera.rows, scene.camera.columns
    is_turned = scan_axis == "auto" and rows != columns and image.shape == (columns, rows)
    if result.failure is not None and is_turned:
        return _decode_picture(scene, options, "columns")
    return result, image


def _report_lines(result: DecodeResult) -> list[str]:
    lines = []
    if result.code is not None:
        if result.payload:
            lines.append(f"payload      {result.payload}")
        else:
            lines.append(f"code         {result.code}")
        lines.append(f"bits         {''.join(map(str, result.bits))}")
    if result.region is not None:
        lines.append(f"region       {result.region}")
    if result.chip_length is not None:
        lines.append(f"chip length  {result.chip_length:.2f} columns")
    if result.confidence is not None:
        lines.append(f"confidence   {result.confidence:.3f}")
    if result.correlation is not None:
        lines.append(f"correlation  {result.correlation:.4f}")
    if result.chips.size:
        lines.append(f"chips        {''.join(map(str, result.chips))}")
    return lines


_RATE_PARTS = 5  # parts of a film for which error rates are reported
_MIN_RATE_PACKETS = 50  # fewest packets for which the rates of parts are reported


def read_film(options: argparse.Namespace, scene: Scene, tolerances: Tolerances) -> int:
    """Read the film that the options name, a colour camera's in three colours, and print all."""
    channel = "colours" if is_colour(scene) else film_channel(options.channel)
    video = load_video(options.file, options.scan_axis, channel=channel)
    with progress_bar(total=video.frame_count, unit="frame", disable=options.follow or None) as bar:

        def report_progress(colour: str, progress: FilmProgress) -> None:
            if options.follow:
                print(f"{colour:5} {_format_progress(progress)}".lstrip(), flush=True)
            else:
                bar.update(progress.frames - bar.n)

        if is_colour(scene):
            readings = decode_colour_video(
                video, scene, options.decoder, progress=report_progress, **tolerances
            )
        else:
            report = partial(report_progress, "")
            reading = decode_video(video, scene, options.decoder, progress=report, **tolerances)
            readings = {"": reading}
    for colour, reading in readings.items():
        heading = f"{colour.capitalize()}:".lstrip(":")
        print(*filter(None, (heading, *_film_lines(reading, video))), sep="\n")
        print_problems(video, reading)
    if options.offset_to is not None:
        print(_offset_line(readings[""], options, scene, tolerances))
    if all(reading.failure is None for reading in readings.values()):
        return 0
    if video.scene is not None and video.scene.transmitter.light != "code":
        light = describe_light(video.scene.transmitter)
        print(f"The film was simulated of this light: {light}; it sends no code.", file=sys.stderr)
    return EXIT_FAILURE


def _offset_line(
    reading: VideoReading, options: argparse.Namespace, scene: Scene, tolerances: Tolerances
) -> str:
    """Compare the times of two films of one LED."""
    channel = film_channel(options.channel)
    other = load_video(options.offset_to, options.scan_axis, channel=channel)
    clock = reading.clock
    other_clock = decode_video(other, scene, options.decoder, **tolerances).clock
    offset = None if clock is None or other_clock is None else clock.offset_of(other_clock)
    if clock is None or offset is None:
        raise ParameterError(
            "--offset-to needs one sure clock of each film; state what is known by "
            "--frequency-tolerance or --readout-tolerance."
        )
    return (
        f"{'offset':18}{one_line(other.title)} is at "
        f"{SECOND.format_estimate(offset.value, offset.error)} when this film begins, or whole "
        f"multiples of {SECOND.format(clock.repeat_time)} earlier or later"
    )


def _format_progress(progress: FilmProgress) -> str:
    """Describe what is known after a frame in one line."""
    frame = progress.frame
    chips = inflect(len(frame.chips), "chip")
    result = frame.failure or f"{chips}, starting with chip {frame.place} of the packet"
    payload = f"  {progress.payload}" if progress.payload else ""
    return (
        f"frame {frame.index:5d}  {SECOND.format(frame.time):>10}  {100.0 * progress.known:3.0f} %"
        f"{payload}  ({result})"
    )


def _film_lines(reading: VideoReading, video: Video) -> list[str]:
    placed = sum(frame.place is not None for frame in reading.frames)
    rows, columns = video.shape
    slow_motion = describe_slow_motion(video, reading.clock)
    lines = [f"{'film':18}{slow_motion}"] if slow_motion else []
    if reading.bits.size:
        lines += [
            f"payload           {reading.payload}",
            f"bits              {''.join(map(str, reading.bits))}",
            f"certainty         {reading.certainty:.4f}",
        ]
    lines.append(
        f"frames            {len(reading.frames)} of {columns} columns, {inflect(rows, 'row')}; "
        f"{placed} of them placed in the packet"
    )
    facts = [*packet_facts(reading), *(() if reading.clock is None else clock_facts(reading.clock))]
    for fact in facts:
        lines.append(f"{fact.label.lower():18}{fact}")
        if fact.key == "packet_error_rate" and len(reading.packets) >= _MIN_RATE_PACKETS:
            lines += _rates_by_part(reading)
    return lines


def _rates_by_part(reading: VideoReading) -> Iterator[str]:
    """Format the packet error rate of each part of the film."""
    for window in reading.rates(_RATE_PARTS):
        if window.packets:
            rate = "{} ({})".format(*error_rate(window.packets_lost, window.packets, "packets"))
            yield f"  {SECOND.format(window.start)} to {SECOND.format(window.end)}: {rate}"
