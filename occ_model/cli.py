"""``occ-model``: the model from the command line."""

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

import occ_model as occ
from occ_model.checks import check_count, check_seed
from occ_model.output import write_image, write_whole
from occ_model.parameters import PARAMETERS
from occ_model.photo.load import SCAN_AXES, Photo
from occ_model.presets import preset_named
from occ_model.receiver.decoders import DECODERS, PAPERS
from occ_model.results import DecodeResult
from occ_model.settings import add_scene_options, scene_of
from occ_model.study.paper_grid import DEVICES, IMAGES, GridPoint, ceases_at, measure, point_count
from occ_model.units import HERTZ

EXIT_FAILURE = 1
"""Nothing was wrong with the command, but no code could be read."""

EXIT_MISUSE = 2
"""The command asked for something that cannot be."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the process's exit code."""
    options = _parser().parse_args(arguments)
    try:
        code: int = options.command(options)
        sys.stdout.flush()
    except occ.OccError as error:
        print(f"occ-model: {error}", file=sys.stderr)
        return EXIT_MISUSE
    except BrokenPipeError:
        # Whoever read our output has stopped; nothing is left to say, not even at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_FAILURE
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="occ-model", description="Simulate and decode rolling-shutter pictures of a panel."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {occ.__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    render = commands.add_parser("render", help="simulate a picture and write it")
    add_scene_options(render)
    render.add_argument("-o", "--out", type=Path, required=True, help="image file to write")
    render.add_argument("--save-scene", type=Path, metavar="FILE", help="also write the scene")
    render.set_defaults(command=_render)

    decode = commands.add_parser("decode", help="read the code from a picture or photo")
    decode.add_argument("file", type=Path, help="image file")
    add_scene_options(decode)
    decode.add_argument("--decoder", choices=tuple(DECODERS), default=PAPERS)
    decode.add_argument(
        "--scan-axis",
        choices=SCAN_AXES,
        default="auto",
        help="what the shutter scanned in the file; auto: across the stripes (default)",
    )
    decode.set_defaults(command=_decode)

    figures = commands.add_parser("figures", help="write the paper's figures 2 to 6")
    figures.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder to fill")
    figures.add_argument("--images", type=int, default=IMAGES, help="a point; default: %(default)s")
    figures.add_argument("--seed", type=int, default=1, help="default: %(default)s")
    for exposure in ("68us", "136us"):
        figures.add_argument(
            f"--photo-{exposure}", type=Path, metavar="FILE", help="its profile is drawn too"
        )
    figures.set_defaults(command=_figures)

    presets = commands.add_parser("presets", help="list the presets, or one with its sources")
    presets.add_argument("name", nargs="?", help="the preset to show whole")
    presets.set_defaults(command=_presets)

    parameters = commands.add_parser("parameters", help="list what --set can set")
    parameters.set_defaults(command=_parameters)
    return parser


def _render(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    frame = occ.render(scene)
    write_image(options.out, frame.image)
    if options.save_scene:
        write_whole(options.save_scene, scene.to_toml().encode("utf-8"))
    rows, columns = frame.image.shape
    milliseconds = 1e3 * sum(frame.timings.values())
    print(f"{options.out}: {columns} columns, {rows} rows, simulated in {milliseconds:.1f} ms")
    return 0


def _decode(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    photo = occ.load_photo(options.file, options.scan_axis)
    result = occ.decode(photo.image, scene, options.decoder)
    for line in _report(result):
        print(line)
    if result.failure is not None:
        print(result.failure, file=sys.stderr)
        return EXIT_FAILURE
    return 0


def _report(result: DecodeResult) -> list[str]:
    lines = []
    if result.code is not None:
        lines += [f"code         {result.code}", f"bits         {''.join(map(str, result.bits))}"]
    if result.region is not None:
        region = result.region
        lines.append(
            f"region       columns {region.first_column} to {region.last_column - 1}, "
            f"rows {region.first_row} to {region.last_row - 1}"
        )
    if result.chip_length is not None:
        lines.append(f"chip length  {result.chip_length:.2f} columns")
    if result.confidence is not None:
        lines.append(f"confidence   {result.confidence:.3f}")
        lines.append(f"correlation  {result.correlation:.4f}")
    if result.chips.size:
        lines.append(f"chips        {''.join(map(str, result.chips))}")
    return lines


def _figures(options: argparse.Namespace) -> int:
    check_count("images", options.images, 1)
    check_seed(options.seed)
    # matplotlib takes half a second to import: only for those who want a figure.
    from occ_model.export import paper_figures
    from occ_model.export.drawing import house_style

    photos = [
        occ.load_photo(path) if path else None for path in (options.photo_68us, options.photo_136us)
    ]
    paper_figures.make_folder(options.out)
    with house_style():
        _draw_figures(options, photos)
    print(f"{options.out}: figures 2 to 6 as PDF, PNG and CSV")
    return 0


def _draw_figures(options: argparse.Namespace, photos: list[Photo | None]) -> None:
    from tqdm import tqdm

    from occ_model.export import paper_figures

    paper_figures.write_process_figure(options.out)
    paper_figures.write_profile_figure(options.out, 3, "phone-68us", photos[0])
    paper_figures.write_profile_figure(options.out, 4, "phone-136us", photos[1])
    decoders = tuple(DECODERS)
    total = sum(point_count(presets, decoders) for presets in DEVICES.values())
    with tqdm(total=total, unit="point", file=sys.stderr) as bar:
        for number, (device, presets) in enumerate(DEVICES.items(), start=5):
            bar.set_description(device)
            points = list(measure(presets, decoders, options.images, options.seed, bar.update))
            paper_figures.write_rate_figure(options.out, number, device, points, options.seed)
            for preset in presets:
                bar.write(_ceasing(preset, points), file=sys.stdout)


def _ceasing(preset: str, points: list[GridPoint]) -> str:
    mine = [p for p in points if p.preset == preset and p.decoder == PAPERS]
    frequency = ceases_at(mine)
    if frequency is None:
        return f"{preset}: detection goes on to the highest frequency"
    return f"{preset}: detection ceases at {HERTZ.format(frequency)}"


def _presets(options: argparse.Namespace) -> int:
    if options.name is None:
        for name in occ.presets():
            print(f"{name:20}{preset_named(name).title}")
        return 0
    preset = preset_named(options.name)
    print(preset.title)
    for name, declaration in PARAMETERS.items():
        value = declaration.format(preset.scene.value(name))  # type: ignore[arg-type]
        note = preset.sources.get(name, "")
        if name in preset.assumed:
            note = f"assumed: {preset.assumed[name]}"
        print(f"{name:26}{value:16}{note}".rstrip())
    return 0


def _parameters(_options: argparse.Namespace) -> int:
    for name, declaration in PARAMETERS.items():
        print(f"{name:26}{declaration.meaning}")
        print(f"{'':26}allowed: {declaration.allowed}")
    return 0
