"""The command ``occ-model sweep``: measure the success rate against any parameters."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from occ_model.commands.bars import run_study
from occ_model.commands.files import TABLE, OutputFiles
from occ_model.commands.options import (
    Commands,
    add_option,
    add_scene_options,
    add_switches,
    add_work_options,
    decoder_name,
    forced_effects,
    scene_of,
)
from occ_model.commands.vary import SYNTAX, axes_of
from occ_model.errors import ParameterError, inflect, one_line
from occ_model.program import EXIT_INTERRUPTED
from occ_model.receiver.decode import DECODERS, QUICK_DECODERS
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import (
    MOST_JOBS,
    SHOWN_QUANTITIES,
    SIGNAL_PATHS,
    RateSettings,
)
from occ_model.scene.argument_checks import check_choice, check_count
from occ_model.scene.scene import TOLERANCE
from occ_model.study.sweep.measure import Progress
from occ_model.study.sweep.request_check import build_request
from occ_model.study.sweep.sweep import run_sweep

BOTH, ALL = "both", "all"

PLOT_ENDINGS = (".png", ".pdf", ".svg")  # of the file of a plot


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("sweep", help="measure the success rate against any parameters")
    add_scene_options(parser)
    parser.add_argument(
        "--vary", action="append", required=True, metavar="NAME=VALUES",
        help=f"{SYNTAX}; may be repeated: all combinations are measured",
    )  # fmt: skip
    add_option(parser, "--images", 5, "a point")
    parser.add_argument(
        "--decoder", action="append", type=_decoder_or_all,
        help=f"one of {', '.join(DECODERS)} or a plug-in's; may be repeated; "
        f"{BOTH}: {' and '.join(QUICK_DECODERS)}; {ALL}: all but plug-ins; default: "
        f"{PAPER_DECODER}",
    )  # fmt: skip
    add_option(
        parser, "--fps", FRAMES_A_SECOND, "images a second (or as many as can be read out), by "
        "which bits a second are counted",
    )  # fmt: skip
    add_option(parser, "--seed", 1)
    add_option(
        parser, "--tolerance", TOLERANCE.default, "how much omitted effects may change the signal "
        "that is decoded, in levels of the stretched profile", metavar="LEVELS",
    )  # fmt: skip
    add_switches(parser)
    add_option(
        parser, "--path", "auto", "image: simulate whole pictures; all others: only what a decoder "
        "reads of them, many at once", choices=SIGNAL_PATHS,
    )  # fmt: skip
    add_work_options(parser)
    parser.add_argument(
        "--plot", type=Path, metavar="FILE",
        help="draw one axis as curves, two as maps; PNG, PDF or SVG by its ending",
    )  # fmt: skip
    add_option(
        parser,
        "--show",
        "rate",
        "success rates in the plot, or bits a second",
        choices=SHOWN_QUANTITIES,
    )
    parser.set_defaults(
        command=_run, writes={"out": TABLE, "plot": OutputFiles(_check_plot_ending)}
    )


def _check_plot_ending(path: Path) -> None:
    check_choice("the plot's ending", path.suffix.lower(), PLOT_ENDINGS)


def _run(options: argparse.Namespace) -> int:
    scene, axes = scene_of(options), axes_of(options.vary)
    settings = RateSettings(
        options.images,
        decoders_of(options.decoder or [PAPER_DECODER]),
        options.seed,
        options.tolerance,
        forced_effects(options),
        options.path,
        options.fps,
    )
    # All arguments are checked before minutes of work begin.
    request = build_request(scene, axes, settings)
    check_count("jobs", options.jobs, 1, MOST_JOBS)
    if options.plot and len(axes) > 2:
        raise ParameterError(
            f"--plot draws one axis or two, not {len(axes)}; leave it out, or vary less."
        )

    def run(progress: Progress) -> SweepTable:
        return run_sweep(request, jobs=options.jobs, progress=progress, results=options.out)

    table = run_study(run, options)
    if table is None:
        return EXIT_INTERRUPTED
    if table.faults:
        print(f"occ-model: {table.faults}", file=sys.stderr)
    if options.out:
        name = one_line(str(options.out))
        print(
            f"{name}: {inflect(request.point_count, 'point')}, "
            f"{inflect(len(settings.decoders), 'rate')} each"
        )
    elif not options.plot:
        sys.stdout.writelines(table.csv())
    if options.plot:
        # Only figures need Matplotlib, whose import takes half a second.
        from occ_model.figures.sweep import write_sweep_figure

        write_sweep_figure(options.plot, table, options.show)
        quantity = {"rate": "success rate", "bits": "bits a second"}[options.show]
        print(f"{one_line(str(options.plot))}: {quantity} over {' and '.join(axes)}")
    return 0


def _decoder_or_all(text: str) -> str:
    return text if text in (BOTH, ALL) else decoder_name(text)


def decoders_of(names: Sequence[str]) -> tuple[str, ...]:
    if ALL in names:
        return tuple(DECODERS)
    return QUICK_DECODERS if BOTH in names else tuple(dict.fromkeys(names))
