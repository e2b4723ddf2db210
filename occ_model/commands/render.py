"""``occ-model render``."""

import argparse
from pathlib import Path

from occ_model.commands.parser import Commands
from occ_model.output import write_image, write_whole
from occ_model.settings import (
    add_scene_options,
    add_simulation_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.simulation import render


def add_to(commands: Commands) -> None:
    """Add the command."""
    parser = commands.add_parser("render", help="simulate a picture and write it")
    add_scene_options(parser)
    add_simulation_options(parser)
    parser.add_argument("-o", "--out", type=Path, required=True, help="image file to write")
    parser.add_argument("--save-scene", type=Path, metavar="FILE", help="also write the scene")
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    settings = simulation_settings_of(options)
    frame = render(scene, **settings.arguments())
    write_image(options.out, frame.image)
    if options.save_scene:
        write_whole(options.save_scene, scene.to_toml().encode("utf-8"))
    rows, columns = frame.image.shape
    milliseconds = 1e3 * sum(frame.timings.values())
    print(f"{options.out}: {columns} columns, {rows} rows, simulated in {milliseconds:.1f} ms")
    return 0
