"""``occ-model figures``."""

import argparse
import sys
from pathlib import Path

from occ_model.commands.files import folder_of_figures
from occ_model.commands.options import Commands
from occ_model.errors import one_line
from occ_model.files.writing import make_folder
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.receiver.decoders import DECODERS, PAPER_DECODER
from occ_model.results.sweep_request import MOST_IMAGES
from occ_model.scene.argument_checks import check_count, check_seed
from occ_model.scene.units import HERTZ
from occ_model.study.paper_grid import DEVICES, IMAGES, GridPoint, ceases_at, measure, point_count


def add_to(commands: Commands) -> None:
    """Add the command."""
    parser = commands.add_parser("figures", help="write the paper's figures 2 to 6")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder to fill")
    parser.add_argument("--images", type=int, default=IMAGES, help="a point; default: %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default: %(default)s")
    for exposure in ("68us", "136us"):
        parser.add_argument(
            f"--photo-{exposure}", type=Path, metavar="FILE", help="its profile is drawn too"
        )
    names = (f"figure-{number}" for number in range(2, 7))
    parser.set_defaults(command=_run, writes={"out": folder_of_figures(*names)})


def _run(options: argparse.Namespace) -> int:
    check_count("images", options.images, 1, MOST_IMAGES)
    check_seed(options.seed)
    # matplotlib takes half a second to import: only for those who want a figure.
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
    from tqdm import tqdm

    from occ_model.figures import paper

    paper.write_process_figure(options.out)
    paper.write_profile_figure(options.out, 3, "phone-68us", photos[0])
    paper.write_profile_figure(options.out, 4, "phone-136us", photos[1])
    decoders = tuple(DECODERS)
    total = sum(point_count(presets, decoders) for presets in DEVICES.values())
    with tqdm(total=total, unit="point", file=sys.stderr) as bar:
        for number, (device, presets) in enumerate(DEVICES.items(), start=5):
            bar.set_description(device)
            points = list(measure(presets, decoders, options.images, options.seed, bar.update))
            paper.write_rate_figure(options.out, number, device, points, options.seed)
            for preset in presets:
                bar.write(_ceasing(preset, points), file=sys.stdout)


def _ceasing(preset: str, points: list[GridPoint]) -> str:
    mine = [p for p in points if p.preset == preset and p.decoder == PAPER_DECODER]
    frequency = ceases_at(mine)
    if frequency is None:
        return f"{preset}: detection goes on to the highest frequency"
    return f"{preset}: detection ceases at {HERTZ.format(frequency)}"
