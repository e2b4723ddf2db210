"""The command ``occ-model most-bits``: the code, frequency and number of bits that carry most."""

import argparse

from occ_model.commands.options import (
    Commands,
    add_option,
    add_scene_options,
    decoder_name,
    scene_of,
)
from occ_model.commands.progress_bar import progress_bar
from occ_model.errors import counted
from occ_model.program import EXIT_FAILURE
from occ_model.results.bit_errors import FRAMES_A_SECOND, MostBits
from occ_model.scene.parameters import quantity
from occ_model.scene.units import HERTZ, SECOND
from occ_model.study import theory
from occ_model.study.most_bits import DECODERS, most_bits

_BAR = "{desc}: {n_fmt} of {total_fmt} combinations tried, {elapsed}"


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "most-bits", help="find the code, frequency and number of bits that carry most"
    )
    add_scene_options(parser)
    parser.add_argument(
        "--decoder", action="append", type=decoder_name,
        help=f"may be repeated; default: {', '.join(DECODERS)}",
    )  # fmt: skip
    add_option(parser, "--fps", FRAMES_A_SECOND, "pictures a second, one payload each")
    add_option(parser, "--pictures", 10, "in which every bit must be read")
    add_option(parser, "--seed", 1)
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    names = tuple(dict.fromkeys(options.decoder or DECODERS))
    with progress_bar(total=1, bar_format=_BAR, leave=False, delay=0.5) as bar:

        def show(decoder: str, done: int, of: int) -> None:
            bar.set_description_str(decoder, refresh=False)
            bar.total = of
            bar.update(done - bar.n)

        found = most_bits(
            scene, names, frames_a_second=options.fps, pictures=options.pictures,
            seed=options.seed, progress=show,
        )  # fmt: skip
    exposure = SECOND.format(scene.camera.exposure_time)
    distance = quantity("distance").format(scene.pose.distance)
    print(
        f"At an exposure of {exposure} and {distance}, {counted(options.fps, 'picture')} a second:"
    )
    for one in found:
        print(f"  {_sentence(one)} {one.faults}".rstrip())
    null = HERTZ.format(theory.null_frequency(scene), 4)
    rows = HERTZ.format(2.0 * theory.row_rate_frequency(scene), 4)
    print(
        f"By theory an alternating pattern has no stripes at {null}, and above {rows} a chip is "
        "shorter than a column."
    )
    return 0 if all(one.scene for one in found) else EXIT_FAILURE


def _sentence(found: MostBits) -> str:
    if found.scene is None:
        return f"{found.decoder}: {found.failure}"
    sent = found.scene.transmitter
    frequency = HERTZ.format(sent.switching_frequency, 3)
    rest = (
        f"none of {found.tried} combinations that carry as much or more was read"
        if found.tried
        else "no combination carries more"
    )
    return (
        f"{found.decoder}: {found.bits_a_second:,.0f} bits a second, "
        f"{counted(sent.payload_length, 'bit')} a picture in {sent.line_code} at {frequency}; "
        f"every bit of {counted(found.pictures, 'picture')} was read, and {rest}."
    )
