"""The commands ``film`` and ``animate`` of ``occ-model``: simulate a film or an animation."""

import argparse
from pathlib import Path

import numpy as np

from occ_model.commands.bars import progress_bar
from occ_model.commands.options import (
    EFFECTS,
    Commands,
    add_option,
    add_scene_options,
    add_simulation_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.commands.vary import SYNTAX, axes_of
from occ_model.errors import ParameterError, inflect, one_line, quote
from occ_model.receiver.decode import DECODERS
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.video import Video
from occ_model.scene.colour_scenes import is_colour
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import parameter_named, quantity
from occ_model.scene.recording import DECLARED, MOTIONS, Recording, Waypoint
from occ_model.scene.units import SECOND
from occ_model.video.file.write import FILM_ENDINGS, LOSSLESS, check_film_path, write_video
from occ_model.video.load import load_video
from occ_model.video.render import render_video

_FRAMES = 90  # frames of a film, three seconds at the usual rate


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("film", help="simulate a film and write it")
    add_scene_options(parser)
    add_simulation_options(parser, EFFECTS)
    add_option(parser, "--frames", _FRAMES, metavar="N")
    for declared in DECLARED:
        default = declared.format(declared.default)
        parser.add_argument(
            f"--{declared.name.replace('_', '-')}",
            default=default,
            metavar="VALUE",
            help=f"{declared.meaning.rstrip('.').lower()}; default: {default}",
        )
    parser.add_argument(
        "--exposures",
        default="",
        metavar="TIMES",
        help="exposure times of the frames in turn, such as 68us,136us; default: the scene's",
    )
    parser.add_argument(
        "--waypoint",
        dest="waypoints",
        metavar="TIME:NAME=VALUE,...",
        action="append",
        default=[],
        help="how far the panel has moved, relative to the camera, at a time, such as "
        "'1s:offset_x=20cm,roll=5deg'; may be repeated, in the order of time",
    )
    parser.add_argument(
        "-o", "--out", type=Path, required=True,
        help=f"file to write: {', '.join(FILM_ENDINGS)}; all except .mp4 keep every grey level, "
        "and .mkv and .png every colour",
    )  # fmt: skip
    parser.set_defaults(command=_run)
    _add_animation(commands)


def _run(options: argparse.Namespace) -> int:
    scene, recording = scene_of(options, may_have_colours=True), _parse_recording(options)
    film = render_video(
        scene, options.frames, recording, settings=simulation_settings_of(options, EFFECTS)
    )
    check_film_path(options.out, recording.frame_rate, film.shape)
    with progress_bar(total=options.frames, unit="frame", leave=False) as bar:
        count = write_video(film, options.out, lambda _done: bar.update())
    rows, columns = film.shape
    gap = recording.gap(film.scene)
    name = one_line(str(options.out))
    print(
        f"{name}: {inflect(count, 'frame')} of {inflect(columns, 'column')}, "
        f"{inflect(rows, 'row')}; "
        f"gap {SECOND.format(gap, 4)}, {100 * recording.gap_ratio(film.scene):.3g} % of a frame"
    )
    if options.out.suffix.lower() not in LOSSLESS or is_colour(scene):
        print(_describe_loss(film, options.out), end="")
    return 0


def _parse_recording(options: argparse.Namespace) -> Recording:
    values = {
        declared.name: declared.parse(getattr(options, declared.name)) for declared in DECLARED
    }
    texts = [text for text in options.exposures.split(",") if text.strip()]
    exposures = tuple(quantity("exposure_time").parse(text) for text in texts)
    path = tuple(_parse_waypoint(text) for text in options.waypoints)
    return Recording(**values, exposure_times=exposures, path=path)  # type: ignore[arg-type]


def _parse_waypoint(text: str) -> Waypoint:
    start, _, rest = text.partition(":")
    time = SECOND.parse(start)
    if time is None or not rest:
        raise ParameterError.of(
            "waypoint",
            quote(text),
            "a time and changes, such as 1s:offset_x=20cm,roll=5deg",
        )
    changes: dict[str, float] = {}
    for part in rest.split(","):
        name, _, value = part.partition("=")
        name = name.strip()
        if name not in MOTIONS:
            raise ParameterError(f"waypoint changes {quote(name)}; allowed: {', '.join(MOTIONS)}.")
        unit = quantity(name).unit
        number = unit.parse(value)
        if number is None:
            raise ParameterError.of(
                f"waypoint's {name}", quote(value), f"a number in {unit.display(1.0)[0]}"
            )
        changes[name] = number
    return Waypoint(time, **changes)


def _describe_loss(film: Video, path: Path) -> str:
    """Describe the loss of the first frame in a file; empty if there is none."""
    simulated = film.frame(0).image
    channel = "luma" if simulated.ndim == 2 else "colours"
    decoded = load_video(path, "columns", channel=channel).frame(0).image
    rows, columns = decoded.shape[:2]
    error = decoded.astype(np.float64) - simulated[:rows, :columns]
    if not error.any():
        return ""
    pixels = np.sqrt(np.mean(error**2))
    means = np.sqrt(np.mean(np.mean(error, axis=0) ** 2))
    return (
        f"The file is lossy: in the first frame pixels differ by {pixels:.2g} levels from the "
        f"simulated ones and column means by {means:.2g} (root mean square).\n"
    )


def _add_animation(commands: Commands) -> None:
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
    parser.set_defaults(command=_animate)


def _animate(options: argparse.Namespace) -> int:
    # Importing Matplotlib takes half a second.
    from occ_model.figures.animation import write_animation

    scene = scene_of(options)
    ((name, values),) = axes_of([options.vary]).items()
    if not isinstance(parameter_named(name), Quantity):
        raise ParameterError(
            f"{name} cannot change in an animation; allowed: a parameter with a unit."
        )
    frame_values = [float(value) for value in values]
    if options.back:
        frame_values += frame_values[-2:0:-1]
    with progress_bar(total=len(frame_values), unit="frame") as bar:
        write_animation(
            options.out, scene, name, frame_values, settings=simulation_settings_of(options),
            rate=options.rate, decoder=options.decoder, progress=lambda _done: bar.update(),
        )  # fmt: skip
    print(f"{one_line(str(options.out))}: {inflect(len(frame_values), 'frame')}")
    return 0
