"""The command ``occ-model accuracy``: time and error of each way to simulate a scene."""

import argparse
import sys
from pathlib import Path

from occ_model.commands.bars import progress_bar
from occ_model.commands.files import folder_of_figures
from occ_model.commands.options import (
    Commands,
    add_scene_options,
    add_simulation_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.errors import one_line
from occ_model.files.writing import make_folder
from occ_model.results.accuracy import AccuracyPoint
from occ_model.study.accuracy import accuracy, point_count


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "accuracy", help="measure the time and the error of each way to simulate a scene"
    )
    add_scene_options(parser)
    add_simulation_options(parser)
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="folder for the figure as PDF, PNG and CSV"
    )
    parser.set_defaults(command=_run, writes={"out": folder_of_figures("accuracy")})


def _run(options: argparse.Namespace) -> int:
    scene, settings = scene_of(options), simulation_settings_of(options)
    results = accuracy(scene, settings)
    if options.out:
        make_folder(options.out)  # refuse a folder before minutes of measurement
    points = []
    with progress_bar(total=point_count(scene, settings), unit="point") as bar:
        for point in results:
            points.append(point)
            bar.write(_format_point(point), file=sys.stdout)
            bar.update()
    if options.out:
        # Only figures need Matplotlib, whose import takes half a second.
        from occ_model.figures.accuracy import write_accuracy_figure

        write_accuracy_figure(options.out, scene, settings, points)
        print(f"{one_line(str(options.out))}: the figure as PDF, PNG and CSV")
    return 0


def _format_point(point: AccuracyPoint) -> str:
    mark = "  <- current" if point.current else ""
    return (
        f"{point.part:12}{point.name:28}{1e3 * point.seconds:10.3f} ms"
        f"{point.error:12.3g} {point.unit}{mark}"
    )
