"""The commands ``render`` and ``plan`` of ``occ-model``: simulate a picture, list its effects."""

import argparse
from pathlib import Path

from occ_model.commands.files import PICTURE, SCENE_FILE
from occ_model.commands.options import (
    EFFECTS,
    Commands,
    add_option,
    add_plan_options,
    add_scene_options,
    add_simulation_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.effects.plan import plan_with
from occ_model.errors import inflect, one_line
from occ_model.files.writing import write_image
from occ_model.results.decoding import overexposed_text
from occ_model.results.frame import PICTURES
from occ_model.scene.colour_scenes import is_colour
from occ_model.scene.from_text import write_scene_file
from occ_model.scene.scene import SimulationSettings
from occ_model.simulation.colour import plan_colours, render_colour_with
from occ_model.simulation.render import overexposed_fraction, render_with


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("render", help="simulate a picture and write it")
    add_scene_options(parser)
    add_simulation_options(parser, EFFECTS)
    picture = (
        "the picture to write: the receiver's, with the scene's enhancement, which decode reads, "
        "or the camera's, like a photo"
    )
    add_option(parser, "--picture", "receiver", picture, choices=PICTURES)
    draft = "make a draft of only every K-th row; 1: a whole picture"
    add_option(parser, "--rows-step", 1, draft, metavar="K")
    parser.add_argument("-o", "--out", type=Path, required=True, help="image file to write")
    parser.add_argument("--save-scene", type=Path, metavar="FILE.toml", help="also write the scene")
    parser.set_defaults(command=_run, writes={"out": PICTURE, "save_scene": SCENE_FILE})
    _add_plan(commands)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options, may_have_colours=True)
    settings = simulation_settings_of(options, EFFECTS)
    if is_colour(scene):
        colours = render_colour_with(scene, settings)
        image, title, step, timings = colours.image, colours.title, 1, colours.timings
        fraction = 0.0
    else:
        frame = render_with(scene, settings, options.rows_step)
        image, title = frame.picture(options.picture), frame.picture_title(options.picture)
        step, timings = frame.rows_step, frame.timings
        fraction = overexposed_fraction(scene, frame.plan, frame.profile, frame.corners)
    write_image(options.out, image, title)
    if options.save_scene:
        write_scene_file(options.save_scene, scene)
    rows, columns = image.shape[:2]
    lines = inflect(rows, "row")
    if step > 1:
        lines = f"{rows} of {inflect(scene.camera.rows, 'row')}"
    print(
        f"{one_line(str(options.out))}: {inflect(columns, 'column')}, {lines}, simulated in "
        f"{1e3 * sum(timings.values()):.1f} ms, {title[:1].lower()}{title[1:]}"
    )
    if fraction:
        print(overexposed_text(fraction))
    return 0


def _add_plan(commands: Commands) -> None:
    parser = commands.add_parser("plan", help="list the effects that a scene needs, and why")
    add_scene_options(parser)
    add_plan_options(parser, EFFECTS)
    defaults = SimulationSettings()
    parser.set_defaults(command=_list_effects, seed=defaults.seed)


def _list_effects(options: argparse.Namespace) -> int:
    scene = scene_of(options, may_have_colours=True)
    settings = simulation_settings_of(options, EFFECTS)
    print(plan_colours(scene, settings) if is_colour(scene) else plan_with(scene, settings))
    return 0
