"""The command ``occ-model camera``: measure a camera by lamps on the mains, or by a flash."""

import argparse
import json
from dataclasses import replace
from pathlib import Path

from occ_model.commands.bars import fraction_bar
from occ_model.commands.options import Commands, add_option
from occ_model.errors import ParameterError
from occ_model.photo.camera.flash import measure_flash
from occ_model.photo.camera.measure import MOST_PICTURES, measure_camera
from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.results.camera import CameraMeasurement
from occ_model.results.flash import FlashMeasurement
from occ_model.scene.parameters import quantity


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "camera", help="measure a camera's readout time by lamps on the mains, or by one flash"
    )
    parser.add_argument(
        "files",
        type=Path,
        nargs="+",
        metavar="PICTURE",
        help="two pictures of a room at 1/1000 s, or a short and a long exposure; or one of an "
        "even wall, which is always doubtful; not cropped, without lens correction",
    )
    light = parser.add_mutually_exclusive_group()
    add_option(light, "--mains", "50Hz", "frequency of the mains", metavar="FREQUENCY")
    light.add_argument(
        "--flash",
        metavar="LENGTH",
        help="the one picture shows the band of a flash of this length, such as 1ms",
    )
    add_option(parser, "--scan-axis", SCAN_AXES[0], choices=SCAN_AXES)
    parser.add_argument("--json", action="store_true", help="print the result as JSON, in SI units")
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    is_flash, count = options.flash is not None, len(options.files)
    if count > (1 if is_flash else MOST_PICTURES):
        allowed = "one picture of a flash" if is_flash else "two pictures of a room, or one"
        raise ParameterError.of("PICTURE", f"{count} times", allowed, verb="is given")
    measured = _measure_by_flash(options) if is_flash else _measure_by_mains(options)
    if options.json:
        print(json.dumps(measured.to_dict(), indent=2))
    else:
        print("\n".join(report_lines(measured)))
    return 0


def _measure_by_flash(options: argparse.Namespace) -> FlashMeasurement:
    length = replace(quantity("exposure_time"), name="--flash").parse(options.flash)
    return measure_flash(options.files[0], length, scan_axis=options.scan_axis)


def _measure_by_mains(options: argparse.Namespace) -> CameraMeasurement:
    mains = quantity("mains_frequency").parse(options.mains)
    with fraction_bar() as progress:
        return measure_camera(options.files, mains, scan_axis=options.scan_axis, progress=progress)


def report_lines(measured: CameraMeasurement | FlashMeasurement) -> list[str]:
    """Describe a measurement in lines, the answer first."""
    facts = [f"  {fact.label:22}{fact}" for fact in measured.facts]
    return [
        measured.sentence,
        *(f"  doubtful: {reason}" for reason in measured.reasons),
        *facts,
        f"  {measured.assumption}",
    ]
