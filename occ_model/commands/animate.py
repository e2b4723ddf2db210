"""The command ``occ-model animate``: film a scene while a parameter changes."""

import argparse
from pathlib import Path

from occ_model.commands.options import (
    Commands,
    add_option,
    add_scene_options,
    add_simulation_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.commands.progress_bar import progress_bar
from occ_model.commands.vary import SYNTAX, axes_of
from occ_model.errors import ParameterError, counted, one_line
from occ_model.receiver.decoders import DECODERS
from occ_model.results.decoding import PAPER_DECODER
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import parameter_named


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("animate", help="write an animation in which a parameter changes")
    add_scene_options(parser)
    add_simulation_options(parser)
    parser.add_argument("--vary", required=True, metavar="AXIS", help=SYNTAX)
    parser.add_argument("--decoder", choices=DECODERS, default=PAPER_DECODER)
    add_option(parser, "--rate", 15.0, "frames a second", metavar="N")
    parser.add_argument("--back", action="store_true", help="also go back to the first value")
    parser.add_argument(
        "-o", "--out", type=Path, required=True, help="file to write: .gif, .mp4 or .png"
    )
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    # matplotlib takes half a second to import.
    from occ_model.figures.animation import write_animation

    scene = scene_of(options)
    ((name, values),) = axes_of([options.vary]).items()
    if not isinstance(parameter_named(name), Quantity):
        raise ParameterError(
            f"{name} cannot change in an animation; allowed: a parameter with a unit."
        )
    run = [float(value) for value in values]
    if options.back:
        run += run[-2:0:-1]
    with progress_bar(total=len(run), unit="frame") as bar:
        write_animation(
            options.out, scene, name, run, settings=simulation_settings_of(options),
            rate=options.rate, decoder=options.decoder, progress=lambda _done: bar.update(),
        )  # fmt: skip
    print(f"{one_line(str(options.out))}: {counted(len(run), 'frame')}")
    return 0
