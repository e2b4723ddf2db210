"""The command ``occ-model bands``: how deep the bars are, and which settings show none."""

import argparse
import math

from occ_model.commands.options import Commands, add_option, add_scene_options, scene_of
from occ_model.results.bands import NO_BARS_DEPTH, BandAdvice, BandDepth, percent
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND, Unit
from occ_model.study.bands.advice import band_advice
from occ_model.study.bands.depth import band_depth
from occ_model.study.bands.eye import eye_flicker

_DIGITS = 4

_RANGES = 6  # most ranges that are listed before the last one


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "bands", help="report the depth of a picture's bars, and which settings have none"
    )
    add_scene_options(parser)
    add_option(
        parser, "--limit", 100.0 * NO_BARS_DEPTH, "depth below which there are no bars",
        metavar="PERCENT",
    )  # fmt: skip
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    advice = band_advice(scene, options.limit / 100.0)
    for line in (*_depth_lines(scene, band_depth(scene)), *_advice_lines(scene, advice)):
        print(line)
    print("\n  ".join(eye_flicker(scene).sentences))
    return 0


def _depth_lines(scene: Scene, depth: BandDepth) -> list[str]:
    exposure = SECOND.format(scene.camera.exposure_time)
    columns = "none" if depth.period == math.inf else f"{depth.period:.4g} columns"
    if scene.camera.columns < depth.period < math.inf:
        columns = f"more than the picture's {scene.camera.columns} columns"
    return [
        f"Bars at {exposure}: {percent(depth.peak_to_peak)} of the mean light peak to peak, "
        f"{percent(depth.rms)} RMS;",
        f"  in the picture's columns {percent(depth.columns.peak_to_peak)} and "
        f"{percent(depth.columns.rms)}, in pixel values {percent(depth.pixel.peak_to_peak)} and "
        f"{percent(depth.pixel.rms)}; from bar to bar: {columns}.",
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
        "Bars peak to peak, of the mean light:",
        "shutter speed  nominal   at the power of two nearby",
    ]
    for each in advice.speeds:
        best = max(each.at_nominal, each.at_real)
        least = min(each.at_nominal, each.at_real)
        verdict = "no bars" if best < advice.limit else ""
        if not verdict and least < advice.limit:
            verdict = (
                "no bars if the camera keeps the former"
                if each.at_nominal == least
                else ("no bars if the camera keeps the latter")
            )
        row = f"{each.name:13}  {percent(each.at_nominal):8}  {percent(each.at_real):8}  {verdict}"
        lines.append(row.rstrip())
    return lines


def _format_range(unit: Unit, ends: tuple[float, float]) -> str:
    return " to ".join(unit.format(end, _DIGITS) for end in ends)


def _list_ranges(ranges: list[str], rest: float | None, unit: Unit) -> str:
    shown = ranges[:_RANGES]
    if len(ranges) > _RANGES:
        shown.append(f"{len(ranges) - _RANGES} more")
    if rest is not None:
        shown.append(f"all from {unit.format(rest, _DIGITS)}" if rest else "all")
    return ", ".join(shown) or "none"
