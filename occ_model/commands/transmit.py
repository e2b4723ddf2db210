"""The command ``occ-model transmit``: write a sketch for a board that blinks the scene."""

import argparse
from pathlib import Path

from occ_model.boards.chip_table import frequency_lines
from occ_model.boards.sketch import BOARDS, DEFAULT_BOARD, SCENE, board_named, file_names
from occ_model.boards.transmission import EYES, Transmission, flicker_sentence, prepare_transmission
from occ_model.boards.waveform_files import choose_wav_timing
from occ_model.commands.files import OutputFiles
from occ_model.commands.options import Commands, add_option, add_scene_options, scene_of
from occ_model.errors import one_line
from occ_model.files.writing import make_folder
from occ_model.scene.units import HERTZ


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "transmit",
        help="write a sketch for a board that blinks the scene",
        description="Write a folder with a sketch that blinks the scene, the waveform as CSV, VCD "
        "and WAV, the wiring as PDF, SVG and PNG, and the scene with the frequency that is sent.",
    )
    add_scene_options(parser)
    add_option(parser, "--board", DEFAULT_BOARD, "the board that blinks", choices=tuple(BOARDS))
    parser.add_argument(
        "-o", "--out", type=Path, required=True, metavar="DIR", help="folder to fill"
    )
    parser.set_defaults(command=_run, writes={"out": _outputs_of})


def _outputs_of(options: argparse.Namespace) -> OutputFiles:
    names = file_names(options.out, board_named(options.board))
    return OutputFiles(names=names)


def _run(options: argparse.Namespace) -> int:
    transmission = prepare_transmission(scene_of(options), board_named(options.board))
    make_folder(options.out)  # refuse a folder before drawing
    # matplotlib takes half a second to import, which only figures need.
    from occ_model.figures.transmitter_files import write_transmitter_files

    paths, missing = write_transmitter_files(options.out, transmission)
    print(f"{one_line(str(options.out))}: {', '.join(sorted(path.name for path in paths))}")
    for line in (
        *_frequency_facts(transmission),
        missing or _wav_sentence(transmission),
        flicker_sentence(transmission),
        EYES,
    ):
        print(line)
    return 0


def _frequency_facts(transmission: Transmission) -> list[str]:
    facts = [" ".join(frequency_lines(transmission))]
    if not transmission.is_exact:
        facts.append(f"{SCENE} has the frequency that is sent; match your photos with it.")
    return facts


def _wav_sentence(transmission: Transmission) -> str:
    """State the frequency error of the WAV file, whose sample rate is a whole number of Hz."""
    timing = choose_wav_timing(transmission)
    return (
        f"WAV: {timing.samples} samples a {transmission.unit} at "
        f"{HERTZ.format(timing.sample_rate)}, {float(timing.error_ppm):+.3g} ppm from the "
        "frequency sent; sound cards block steady light and smooth the edges."
    )
