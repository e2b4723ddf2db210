"""The command ``occ-model figures``: write the paper's figures 2 to 6."""

import argparse
import sys
from pathlib import Path
from typing import Any

from occ_model.commands.bars import progress_bar
from occ_model.commands.files import folder_of_figures
from occ_model.commands.options import Commands, add_option
from occ_model.errors import one_line
from occ_model.files.writing import make_folder
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import MOST_IMAGES, MOST_JOBS, SweepRequest
from occ_model.scene.argument_checks import check_count, check_seed
from occ_model.scene.units import HERTZ
from occ_model.study.paper_grid import DEVICES, IMAGES, find_detection_limit, grid_request
from occ_model.study.sweep.measure import Progress
from occ_model.study.sweep.sweep import run_sweep


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "figures",
        help="write the paper's figures 2 to 6",
        epilog="If it is stopped, by Ctrl-C or otherwise, the measured rates stay in the "
        "folder of --out until their figure is written; the same command continues from there.",
    )
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder to fill")
    add_option(parser, "--images", IMAGES, "a point")
    add_option(parser, "--seed", 1)
    add_option(parser, "--jobs", 1, "processes", metavar="N")
    for exposure in ("68us", "136us"):
        parser.add_argument(
            f"--photo-{exposure}",
            type=Path,
            metavar="FILE",
            help="a photo whose profile is also drawn",
        )
    names = (f"figure-{number}" for number in range(2, 7))
    parser.set_defaults(command=_run, writes={"out": folder_of_figures(*names)})


def _run(options: argparse.Namespace) -> int:
    check_count("images", options.images, 1, MOST_IMAGES)
    check_seed(options.seed)
    check_count("jobs", options.jobs, 1, MOST_JOBS)
    # Only figures need Matplotlib, whose import takes half a second.
    from occ_model.figures.drawing import house_style

    photos = [
        load_photo(path) if path else None for path in (options.photo_68us, options.photo_136us)
    ]
    make_folder(options.out)
    with house_style():
        _draw_figures(options, photos)
    print(f"{one_line(str(options.out))}: figures 2 to 6 as PDF, PNG and CSV")
    return 0


def _draw_figures(options: argparse.Namespace, photos: list[Photo | None]) -> None:
    from occ_model.figures import paper

    paper.write_process_figure(options.out)
    paper.write_profile_figure(options.out, 3, "phone-68us", photos[0])
    paper.write_profile_figure(options.out, 4, "phone-136us", photos[1])
    requests = _requests(options)
    points = sum(request.point_count for request in requests.values())
    with progress_bar(total=points, unit="point") as bar:
        for number, (device, presets) in enumerate(DEVICES.items(), start=5):
            bar.set_description(device)
            tables = {
                preset: run_sweep(
                    requests[preset],
                    jobs=options.jobs,
                    progress=_continue_bar(bar),
                    results=_rates_file(options, preset),
                )
                for preset in presets
            }
            paper.write_rate_figure(options.out, number, device, tables)
            for preset, table in tables.items():
                _rates_file(options, preset).unlink()
                bar.write(detection_sentence(preset, table), file=sys.stdout)


def _continue_bar(bar: Any) -> Progress:
    """Return a callback that advances a bar by the points of one sweep."""
    start = bar.n
    return lambda done, _total, _left: bar.update(start + done - bar.n)


def _requests(options: argparse.Namespace) -> dict[str, SweepRequest]:
    return {
        preset: grid_request(preset, QUICK_DECODERS, options.images, options.seed)
        for presets in DEVICES.values()
        for preset in presets
    }


def _rates_file(options: argparse.Namespace, preset: str) -> Path:
    """Return the file that stores the rates until their figure is written."""
    folder: Path = options.out
    return folder / f"rates-{preset}-images-{options.images}-seed-{options.seed}.csv"


def detection_sentence(preset: str, table: SweepTable) -> str:
    last, first_unread = find_detection_limit(table, PAPER_DECODER)
    if first_unread is None:
        return f"{preset}: read up to the highest frequency tried"
    if last is None:
        return f"{preset}: read at none of the frequencies tried"
    return (
        f"{preset}: of the frequencies tried, {HERTZ.format(last)} is the last that is read at "
        f"some distance, {HERTZ.format(first_unread)} the first at none"
    )
