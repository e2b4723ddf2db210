"""The command ``occ-model bands``: how deep the bars are, and which settings show none."""

import argparse
import math
import re

from occ_model.commands.options import Commands, add_option, add_scene_options, scene_of
from occ_model.errors import ParameterError, quote
from occ_model.results.bands import (
    NO_BARS_DEPTH,
    OF_MEAN_LIGHT,
    BandAdvice,
    BandDepth,
    depth_text,
    format_depth,
)
from occ_model.results.bars_answer import ROWS
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND, Unit
from occ_model.study.bands.advice import band_advice
from occ_model.study.bands.answer import bars_answer
from occ_model.study.bands.depth import band_depth
from occ_model.study.bands.eye import eye_flicker

_DIGITS = 4

_RANGES = 6  # most ranges that are listed before the last one


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "bands", help="say which shutter speeds show no bars of a lamp, and how deep they are"
    )
    add_scene_options(parser)
    add_option(
        parser, "--limit", 100.0 * NO_BARS_DEPTH, "depth below which there are no bars",
        metavar="PERCENT",
    )  # fmt: skip
    lamps = _LAMPS.replace("%", "%%")  # because argparse formats help with %
    parser.add_argument("--lamp", metavar="TEXT", help=f"a lamp in place of a scene: {lamps}")
    parser.add_argument("--shutter", metavar="TIME", help="the shutter time of a camera: 1/100")
    parser.add_argument("--readout", metavar="TIME", help="the time from line to line: 12us")
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    rows, scene = 0, scene_of(options)
    if options.lamp is not None:
        light, rows = _parse_lamp(options.lamp)
        scene = scene.replace(**light, illuminance=0.0)
    for name, text in (("exposure_time", options.shutter), ("readout_time", options.readout)):
        if text is not None:
            scene = scene.replace(**{name: quantity(name).parse(text)})
    knows_readout = options.lamp is None or options.readout is not None
    scene_lines = [] if options.lamp is not None else _scene_lines(scene, options.limit / 100.0)
    answer = bars_answer(scene, knows_readout=knows_readout, rows=rows)
    for line in (answer.sentence, *(f"  {detail}" for detail in answer.details), *scene_lines):
        print(line)
    return 0


def _scene_lines(scene: Scene, limit: float) -> list[str]:
    advice = band_advice(scene, limit)
    return [
        *_depth_lines(scene, band_depth(scene)),
        *_advice_lines(scene, advice),
        "\n  ".join(eye_flicker(scene).sentences),
    ]


_LAMPS = "240Hz 30%, mains 50Hz, or 60Hz 1/16 rows for a panel whose rows are lit in turn"


def _parse_lamp(text: str) -> tuple[dict[str, ParameterValue], int]:
    """Return the parameters of a lamp, and how many rows of it are lit in turn; 0: all at once."""
    words = re.sub(r"\s+(k?Hz|%)", r"\1", text).split()
    kinds = set(words) & {"mains", "rows"}
    frequency, *others = [word for word in words if word not in kinds] or [""]
    if kinds == {"mains"} and not others:
        mains = quantity("mains_frequency").parse(frequency)
        return {"light": "mains", "mains_frequency": mains}, 0
    if "mains" in kinds or len(others) != 1:
        raise ParameterError(f"lamp is {quote(text)}; allowed: {_LAMPS}.")
    lamp = quantity("lamp_frequency").parse(frequency)
    if not kinds:
        duty = quantity("duty").parse(others[0])
        return {"light": "lamp", "lamp_frequency": lamp, "duty": duty, "depth": 1.0}, 0
    rows = ROWS.parse(others[0].removeprefix("1/"))
    return {"light": "lamp", "lamp_frequency": lamp, "duty": 1.0 / rows, "depth": 1.0}, rows


def _depth_lines(scene: Scene, depth: BandDepth) -> list[str]:
    exposure = SECOND.format(scene.camera.exposure_time)
    columns = "none" if depth.period == math.inf else f"{depth.period:.4g} columns"
    if scene.camera.columns < depth.period < math.inf:
        columns = f"more than the picture's {scene.camera.columns} columns"
    return [
        f"Bars at {exposure}: {depth_text(depth.peak_to_peak)}, {format_depth(depth.rms)} RMS;",
        f"  in the picture's columns {format_depth(depth.columns.peak_to_peak)} and "
        f"{format_depth(depth.columns.rms)}, in pixel values "
        f"{format_depth(depth.pixel.peak_to_peak)} and "
        f"{format_depth(depth.pixel.rms)}; from bar to bar: {columns}.",
        f"  {depth.sentence}",
    ]


def _advice_lines(scene: Scene, advice: BandAdvice) -> list[str]:
    limit = f"{100.0 * advice.limit:.3g} %"
    frequency = HERTZ.format(advice.axis.frequency, _DIGITS)
    exposure = SECOND.format(scene.camera.exposure_time)
    exposures = [_format_range(SECOND, ends) for ends in advice.exposures]
    frequencies = [_format_range(HERTZ, ends) for ends in advice.frequencies]
    lines = [
        advice.sentence,
        f"At {frequency} exposures with less than {limit}: "
        f"{_list_ranges(exposures, advice.all_exposures, SECOND)}.",
        f"At {exposure}, by {advice.axis.label.lower()}, less than {limit}: "
        f"{_list_ranges(frequencies, advice.all_frequencies, HERTZ)}.",
    ]
    if scene.transmitter.edge_time:
        lines.append("  Both are for sharp edges; with the LED's edges the ranges are wider.")
    lines += [
        f"Depth of the bars, {OF_MEAN_LIGHT}:",
        "shutter speed  nominal   at the power of two nearby",
    ]
    for speed in advice.speeds:
        largest = max(speed.at_nominal, speed.at_real)
        smallest = min(speed.at_nominal, speed.at_real)
        verdict = "no bars" if largest < advice.limit else ""
        if not verdict and smallest < advice.limit:
            verdict = (
                "no bars if the camera uses the nominal time"
                if speed.at_nominal == smallest
                else "no bars if the camera uses the power of two"
            )
        depths = f"{format_depth(speed.at_nominal):8}  {format_depth(speed.at_real):8}"
        row = f"{speed.name:13}  {depths}  {verdict}"
        lines.append(row.rstrip())
    return lines


def _format_range(unit: Unit, ends: tuple[float, float]) -> str:
    return " to ".join(unit.format(end, _DIGITS) for end in ends)


def _list_ranges(ranges: list[str], rest: float | None, unit: Unit) -> str:
    texts = ranges[:_RANGES]
    if len(ranges) > _RANGES:
        texts.append(f"{len(ranges) - _RANGES} more")
    if rest is not None:
        texts.append(f"all from {unit.format(rest, _DIGITS)}" if rest else "all")
    return ", ".join(texts) or "none"
