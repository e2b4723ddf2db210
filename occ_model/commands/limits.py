"""The commands ``limits`` and ``most-bits`` of ``occ-model``: how fast a scene can be read."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace

from occ_model.commands.bars import progress_bar
from occ_model.commands.options import (
    Commands,
    add_option,
    add_scene_options,
    decoder_name,
    number,
    scene_of,
)
from occ_model.errors import inflect
from occ_model.program import EXIT_FAILURE
from occ_model.receiver.decode import DECODERS
from occ_model.results.bit_errors import FRAMES_A_SECOND, MostBits
from occ_model.results.limit_text import (
    end_text,
    format_end,
    limit_text,
    others_text,
    present_rate_text,
    search_end_text,
    search_sentences,
    sent_text,
    theory_text,
    two_packets_text,
)
from occ_model.results.limits import Limits, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.colour_scenes import is_colour
from occ_model.scene.parameters import quantity
from occ_model.scene.parameters.colour import COLOURS
from occ_model.scene.recording import FRAME_RATE
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND
from occ_model.study import theory
from occ_model.study.limits import advice_of, check_search, limits_of
from occ_model.study.most_bits import DECODERS as MOST_BITS_DECODERS, most_bits
from occ_model.study.success_rate import check_rate
from occ_model.study.working_range import READ_RATE, rough_range

_BAR = "{desc}: {percentage:3.0f} %|{bar}| {elapsed}, about {remaining} left"


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "limits", help="find how fast a scene can send, and how long it can be exposed"
    )
    add_scene_options(parser)
    parser.add_argument(
        "--decoder",
        type=decoder_name,
        action="append",
        help=f"one of {', '.join(DECODERS)} or a plug-in's; may be repeated; default: these",
    )
    parser.add_argument(
        "--rate", type=number, default=READ_RATE, metavar="PERCENT",
        help="of the bits that counts as read; default: %(default)s",
    )  # fmt: skip
    add_option(parser, "--images", 20, "at each value; more images make the answer more certain")
    add_option(
        parser, "--fps", FRAMES_A_SECOND,
        "pictures a second (or as many as can be read out), with one payload each",
    )  # fmt: skip
    add_option(parser, "--seed", 1)
    add_option(
        parser, "--jobs", 2, "processes, at most two; the answer is the same with one", metavar="N"
    )
    parser.set_defaults(command=_run)
    _add_most_bits(commands)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options, may_have_colours=True)
    FRAME_RATE.check(options.fps)
    check_search(options.rate, options.jobs)
    if not is_colour(scene):
        return _print_limits(options, scene)
    codes = []
    for colour in COLOURS:
        print(f"{colour.capitalize()}:")
        codes.append(_print_limits(options, scene.colour(colour)))
    return max(codes)


def _print_limits(options: argparse.Namespace, scene: Scene) -> int:
    decoders = tuple(dict.fromkeys(options.decoder or DECODERS))
    settings = RateSettings(options.images, decoders, options.seed)
    check_rate(scene, settings)
    for line in _heading_lines(scene, options):
        print(line, flush=True)
    answers: list[Limits] = []
    with progress_bar(total=100, unit="%", bar_format=_BAR, leave=False) as bar:
        rough = "" if bar.disable else _rough_text(scene, settings, options.rate)
        bar.set_description_str(rough)

        def show(fraction: float, what: str) -> None:
            bar.set_description_str(what if answers else rough, refresh=False)
            bar.update(round(100.0 * fraction) - bar.n)

        for limits in limits_of(scene, settings, options.rate, jobs=options.jobs, progress=show):
            answers.append(limits)
            bar.write(format_row(limits, options.fps), file=sys.stdout)
            sys.stdout.flush()
    for line in sentences(answers, options.fps):
        print(line)
    reads = any(limits.highest_frequency and limits.longest_exposure for limits in answers)
    return 0 if reads else EXIT_FAILURE


def _rough_text(scene: Scene, settings: RateSettings, rate: float) -> str:
    """State roughly which frequencies the first decoder reads, while its limits are sought."""
    name, first = "switching_frequency", settings.decoders[:1]
    found = rough_range(scene, name, rate, replace(settings, decoders=first))
    ends = (format_end(name, end) for end in (found.lowest, found.highest))
    return f"{first[0]} roughly {' to '.join(ends)}"


_COLUMNS = (
    "decoder", "lowest", "highest", "again", "shortest", "longest", "again", "bits a second",
)  # fmt: skip
_WIDTHS = (10, 31, 31, 38, 31, 31, 38, 14)


def _heading_lines(scene: Scene, options: argparse.Namespace) -> list[str]:
    exposure = SECOND.format(scene.camera.exposure_time)
    frequency = HERTZ.format(scene.transmitter.switching_frequency)
    distance = quantity("distance").format(scene.pose.distance)
    return [
        f"Read with {options.rate:g} % of the bits at {distance}, sending {sent_text(scene)}: "
        f"frequencies at {exposure}, exposures and bits a second at {frequency}.",
        _align_cells(_COLUMNS),
    ]


def _align_cells(cells: Sequence[str]) -> str:
    padded = [cell.ljust(width) for cell, width in zip(cells, _WIDTHS, strict=True)]
    return "  ".join(padded).rstrip()


def format_row(found: Limits, frames_a_second: float = FRAMES_A_SECOND) -> str:
    """Format the limits of a decoder as a line of the table."""
    cells = [found.decoder]
    for working_range in (found.frequency, found.exposure):
        cells += range_cells(working_range)
    return _align_cells([*cells, f"{found.bits_a_second(frames_a_second):.4g}"])


def range_cells(found: WorkingRange) -> tuple[str, str, str]:
    """Format both ends of what is read without a gap, and what is read beyond gaps."""
    if found.lowest is None or found.highest is None:
        return "none", "none", ""
    low, high = (limit_text(found.parameter, end) for end in (found.lowest, found.highest))
    return low, high, others_text(found) or "no"


def sentences(answers: Sequence[Limits], frames_a_second: float = FRAMES_A_SECOND) -> list[str]:
    """State the images that confirmed the ends, and the theoretical limits."""
    lines: list[str] = []
    advices = [advice_of(found) for found in answers]
    for found, advice in zip(answers, advices, strict=True):
        if advice.cause:
            lines.append(
                f"The {found.decoder} decoder does not read the scene as it is. {advice.cause}"
            )
        for working_range in (found.frequency, found.exposure):
            lines += _range_lines(found.decoder, working_range)
        two_packets = advice.frequency.two_packets
        if two_packets is not None:
            lines.append(f"  {two_packets_text(two_packets)}")
        lines.append(f"  {present_rate_text(found, frames_a_second)}")
    lines += dict.fromkeys(line for found in answers for line in search_sentences(found))
    lines.append(theory_text("switching_frequency", advices[0].frequency))
    lines.append(theory_text("exposure_time", advices[0].exposure))
    return lines


def _range_lines(decoder: str, found: WorkingRange) -> list[str]:
    faults = [found.faults] if found.faults else []
    if found.failure is not None:
        return [found.failure, *faults]
    name = found.parameter
    lines = [f"The {decoder} decoder, {quantity(name).in_sentence}:"]
    for index, interval in enumerate(found.intervals):
        if index:
            lines.append("  beyond a gap:")
        ends = (interval.lowest, interval.highest)
        lines += [f"  {format_end(name, end)}: {end_text(name, end)}" for end in ends]
    if found.most_chips is not None:
        lines.append(f"  {search_end_text(found)}")
    return lines + faults


_TRIED_BAR = "{desc}: {n_fmt} of {total_fmt} combinations tried, {elapsed}"


def _add_most_bits(commands: Commands) -> None:
    parser = commands.add_parser(
        "most-bits", help="find the code, frequency and number of bits of the highest bit rate"
    )
    add_scene_options(parser)
    parser.add_argument(
        "--decoder", action="append", type=decoder_name,
        help=f"may be repeated; default: {', '.join(MOST_BITS_DECODERS)}",
    )  # fmt: skip
    add_option(parser, "--fps", FRAMES_A_SECOND, "pictures a second, one payload each")
    add_option(parser, "--pictures", 10, "in which every bit must be read")
    add_option(parser, "--seed", 1)
    parser.set_defaults(command=_search_most_bits)


def _search_most_bits(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    names = tuple(dict.fromkeys(options.decoder or MOST_BITS_DECODERS))
    with progress_bar(total=1, bar_format=_TRIED_BAR, leave=False, delay=0.5) as bar:

        def show(decoder: str, done: int, of: int) -> None:
            bar.set_description_str(decoder, refresh=False)
            bar.total = of
            bar.update(done - bar.n)

        found = most_bits(
            scene, names, frames_a_second=options.fps, pictures=options.pictures,
            seed=options.seed, progress=show,
        )  # fmt: skip
    exposure = SECOND.format(scene.camera.exposure_time)
    distance = quantity("distance").format(scene.pose.distance)
    print(
        f"At an exposure of {exposure} and {distance}, {inflect(options.fps, 'picture')} a second:"
    )
    for result in found:
        print(f"  {_describe_best(result)} {result.faults}".rstrip())
    null = HERTZ.format(theory.null_frequency(scene), 4)
    rows = HERTZ.format(2.0 * theory.row_rate_frequency(scene), 4)
    print(
        f"By theory an alternating pattern has no stripes at {null}, and above {rows} a chip is "
        "shorter than a column."
    )
    return 0 if all(result.scene for result in found) else EXIT_FAILURE


def _describe_best(found: MostBits) -> str:
    if found.scene is None:
        return f"{found.decoder}: {found.failure}"
    sent = found.scene.transmitter
    frequency = HERTZ.format(sent.switching_frequency, 3)
    rest = (
        f"none of {found.tried} combinations that carry as much or more was read"
        if found.tried
        else "no combination carries more"
    )
    return (
        f"{found.decoder}: {found.bits_a_second:,.0f} bits a second, "
        f"{inflect(sent.payload_length, 'bit')} a picture in {sent.line_code} at {frequency}; "
        f"every bit of {inflect(found.pictures, 'picture')} was read, and {rest}."
    )
