"""The command ``occ-model decode``: read the code from a picture, a photo or a film."""

import argparse
import sys
from pathlib import Path

from occ_model.commands.film_reading import read_film
from occ_model.commands.options import (
    Commands,
    add_scene_options,
    decoder_name,
    number,
    scene_of,
)
from occ_model.files.film_kinds import is_film
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import load_photo
from occ_model.program import EXIT_FAILURE
from occ_model.receiver.decode import decode
from occ_model.receiver.decoders import DECODERS, PAPER_DECODER
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.video.clock import READOUT_TOLERANCE


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
    parser.add_argument(
        "--scan-axis",
        choices=SCAN_AXES,
        default="auto",
        help="what the shutter scanned in the file; auto: across the stripes (default)",
    )
    parser.add_argument(
        "--channel",
        choices=CHANNELS,
        default="brightest",
        help="what of a coloured photo is read; brightest: the colour with the largest mean "
        "(default); of a film red, green or blue, else its luma",
    )
    parser.add_argument(
        "--follow", action="store_true", help="of a film: print what is known after each frame"
    )
    parser.add_argument(
        "--readout-tolerance",
        type=number,
        default=100.0 * READOUT_TOLERANCE,
        metavar="PERCENT",
        help="of a film: by how much the readout time may be another one; default: %(default)g",
    )
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    if options.follow or is_film(options.file):
        return read_film(options, scene)
    result = _decoded(scene, options, options.scan_axis)
    for line in _report(result):
        print(line)
    if result.failure is not None:
        print(result.failure, file=sys.stderr)
        return EXIT_FAILURE
    return 0


def _decoded(scene: Scene, options: argparse.Namespace, scan_axis: str) -> DecodeResult:
    """Read a picture; one of the scene's size that holds no code turned is taken as it lies."""
    image = load_photo(options.file, scan_axis, channel=options.channel).image
    result = decode(image, scene, options.decoder)
    rows, columns = scene.camera.rows, scene.camera.columns
    is_turned = scan_axis == "auto" and rows != columns and image.shape == (columns, rows)
    if result.failure is not None and is_turned:
        return _decoded(scene, options, "columns")
    return result


def _report(result: DecodeResult) -> list[str]:
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
        lines.append(f"correlation  {result.correlation:.4f}")
    if result.chips.size:
        lines.append(f"chips        {''.join(map(str, result.chips))}")
    return lines
