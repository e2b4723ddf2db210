"""The command ``occ-model match``: find the settings that explain a photo."""

import argparse
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from occ_model.commands.bars import fraction_bar
from occ_model.commands.film_lines import add_tolerances
from occ_model.commands.match_film import match_film
from occ_model.commands.match_many import add_many_options, outputs_of_match, run_many
from occ_model.commands.options import (
    Commands,
    add_option,
    add_scene_options,
    is_stated,
    scene_of,
)
from occ_model.errors import MatchError, ParameterError, one_line, quote
from occ_model.files.reading import is_film
from occ_model.photo.chips.read import read_chips
from occ_model.photo.lamps.match import match_lamps
from occ_model.photo.match import ESTIMATES, PATTERN_SOURCES, match_photo
from occ_model.photo.match_facts import format_facts, match_facts
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.results.chip_reading import ChipReading
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match, known_parameter
from occ_model.results.match_sentence import describe_match
from occ_model.results.photo_table import assumption
from occ_model.scene.from_text import write_scene_file
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import Unit


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("match", help="find the settings that explain a photo or film")
    parser.add_argument("file", type=Path, help="photo or film; several photos give one table")
    add_many_options(parser)
    add_scene_options(parser)
    parser.add_argument(
        "--led-frequency",
        metavar="FREQUENCY",
        help="a lamp with this frequency blinks, such as 1kHz; short for "
        "--set light=lamp --set lamp_frequency=1kHz",
    )
    sent = "scene: what the scene sends; read: read it from the stripes; auto: whichever fits"
    add_option(parser, "--sent", PATTERN_SOURCES[0], sent, choices=PATTERN_SOURCES)
    unknown = "the parameter that is not known; switching_frequency stands for a lamp's, too"
    add_option(parser, "--estimate", ESTIMATES[0], unknown, choices=ESTIMATES)
    parser.add_argument("--fit-gamma", action="store_true", help="also estimate gamma")
    add_option(parser, "--scan-axis", SCAN_AXES[0], choices=SCAN_AXES)
    add_option(parser, "--channel", CHANNELS[0], choices=CHANNELS)
    area_options = parser.add_mutually_exclusive_group()
    area_options.add_argument(
        "--region",
        metavar="R0:R1,C0:C1",
        help="search only rows R0 to before R1 and columns C0 to before C1; columns are the scan "
        "axis",
    )
    area_options.add_argument(
        "--lamps", action="store_true", help="find every lamp and match each by itself"
    )
    parser.add_argument(
        "--chips",
        action="store_true",
        help="only read the chips in view, which need not repeat or be known",
    )
    add_tolerances(parser)
    parser.add_argument(
        "--out",
        type=Path,
        metavar="FILE",
        help="file for the fitted scene (.toml), or for the table of several photos (.csv)",
    )
    parser.set_defaults(command=_run, writes={"out": outputs_of_match})


def _run(options: argparse.Namespace) -> int:
    _check_options(options)
    region = None if options.region is None else parse_region(options.region)
    scene = scene_of(options)
    if options.led_frequency is not None:
        declared = replace(quantity("lamp_frequency"), name="--led-frequency")
        frequency = declared.parse(options.led_frequency)
        scene = scene.replace(light="lamp", lamp_frequency=frequency)
    if options.more:
        return run_many(options, scene)
    if is_film(options.file):
        return match_film(options, scene)
    photo = load_photo(options.file, options.scan_axis, channel=options.channel)
    if options.chips:
        print("\n".join(chip_lines(read_chips(photo, region))))
        return 0
    if options.lamps:
        return _run_lamps(photo, scene, options)
    with fraction_bar() as progress:
        match = match_photo(photo, scene, region=region, progress=progress, **_fit_options(options))
    print("\n".join(_report_lines(match, scene, photo, options)))
    if options.out:
        write_scene_file(options.out, match.scene)
        print(f"{one_line(str(options.out))}: the fitted scene")
    return 0


def _check_options(options: argparse.Namespace) -> None:
    if options.out and (options.lamps or options.chips):
        option = "--lamps" if options.lamps else "--chips"
        raise ParameterError(f"--out is given with {option}; allowed: with a single match.")
    if options.lamps and options.chips:
        raise ParameterError("--chips is given with --lamps; read each lamp with its --region.")
    if options.more and (options.lamps or options.region or options.chips):
        raise ParameterError(
            "--lamps, --region or --chips is given with several photos; name one photo."
        )
    if options.known and not options.more:
        raise ParameterError("--known is given with one photo; allowed: --led-frequency or --set.")


def _run_lamps(photo: Photo, scene: Scene, options: argparse.Namespace) -> int:
    with fraction_bar() as progress:
        lamp_matches = match_lamps(photo, scene, progress=progress, **_fit_options(options))
    if not lamp_matches:
        raise MatchError(
            "No lamp was found: no place is much brighter than the rest of the photo, and none has "
            "stripes with sharp edges. Without --lamps the stripes of the whole photo are matched."
        )
    for number, (lamp, match) in enumerate(lamp_matches, 1):
        lines = lamp_lines(number, lamp)
        if isinstance(match, Match):
            lines += _report_lines(match, scene, photo, options)
        else:
            lines.append(str(match))
        print("\n  ".join(lines))
    return 0


def _fit_options(options: argparse.Namespace) -> dict[str, Any]:
    """Return the options that hold for a single photo, whether it or its lamps are matched."""
    return {name: getattr(options, name) for name in ("estimate", "sent", "fit_gamma")}


def _report_lines(
    match: Match, scene: Scene, photo: Photo, options: argparse.Namespace
) -> list[str]:
    """Describe a match, with the value on which times depend unless the command line states it."""
    is_known = is_stated(known_parameter(options.estimate, scene.transmitter), options)
    known = "" if is_known else assumption(match.known, getattr(match, match.known))
    verdict = [f"{'verdict':22}{match.verdict}", *(f"{'':22}{why}" for why in match.all_reasons)]
    return [
        describe_match(match, known),
        *verdict,
        *format_facts(match_facts(match, known, photo.exposure_time)),
    ]


_REGION = re.compile(r"(\d{1,9}):(\d{1,9}),(\d{1,9}):(\d{1,9})")


def parse_region(text: str) -> Region:
    """Parse the rectangle ``R0:R1,C0:C1``: rows R0 to before R1, columns C0 to before C1."""
    fields = _REGION.fullmatch(text.strip())
    if fields is None:
        raise ParameterError.of(
            "--region",
            quote(text),
            "R0:R1,C0:C1, such as 100:800,0:1920: the first row, the row after the last, and the "
            "same for columns",
        )
    return Region(*(int(number) for number in fields.groups()))


def lamp_lines(number: int, lamp: Lamp) -> list[str]:
    lines = [f"lamp {number}: {lamp.region}, grey level {lamp.level:.0f}"]
    product, deviation = lamp.switching_frequency_times_readout, lamp.product_uncertainty
    if product is None or deviation is None:
        return lines
    estimate = Unit("chips a column").format_estimate(product, deviation)
    if lamp.period is not None and lamp.period_uncertainty is not None:
        cycles, deviation = 1.0 / lamp.period, lamp.period_uncertainty / lamp.period**2
        estimate = Unit("periods a column").format_estimate(cycles, deviation)
    lines.append(f"frequency times readout time {estimate}")
    if lamp.periods is not None:
        lines.append(f"{lamp.periods:.1f} periods in view")
    lines += [f"doubtful: {doubt}" for doubt in lamp.doubts]
    if lamp.reflections:
        lines.append(f"reflected at {', '.join(map(str, lamp.reflections))}")
    return lines


def chip_lines(reading: ChipReading) -> list[str]:
    return [
        f"{'chips':22}{reading.text}",
        f"{'chips in view':22}{len(reading.chips)}, between the first and the last edge",
        f"{'chip length':22}{reading.columns_per_chip:.3f} columns",
        f"{'first chip from':22}column {reading.start:.1f}",
        f"{'certainty':22}{100.0 * reading.confidence:.0f} % that all chips are right",
        f"{'region':22}{reading.region}",
    ]
