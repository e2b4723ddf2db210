"""The command ``occ-model bench``: bit error rates of schemes and decoders."""

import argparse
from pathlib import Path

from occ_model.commands.bars import progress_bar
from occ_model.commands.files import folder_of_figures
from occ_model.commands.options import Commands, add_option, decoder_name, number
from occ_model.files.writing import make_folder
from occ_model.receiver.decode import decoders
from occ_model.results.bit_errors import FRAMES_A_SECOND, BenchPoint, BenchRequest
from occ_model.study.bench.bench import (
    bench,
    bench_scene,
    check_bench,
)
from occ_model.study.bit_error_rate import check_frame_rate

_DEFAULT_REQUEST = BenchRequest()
_NUMBERS = {  # the option of each number of a request: flag, metavar and meaning
    "at_exposure": ("--at-exposure", "SYMBOLS", "of the curve against noise"),
    "at_decibels": ("--at-snr", "DB", "of the curve against exposure"),
    "rows_a_symbol": ("--rows", "ROWS", "read out during a symbol"),
    "payload_bits": ("--payload-bits", "BITS", "of a payload; each picture has one"),
    "bits": ("--bits", "BITS", "at least, for each point"),
}


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("bench", help="compare bit error rates against exposure and noise")
    defaults = _DEFAULT_REQUEST
    for flag, field, kind, metavar, meaning, default in (
        ("--scheme", "schemes", str, "LINE_CODE[/FRAMING]", "", defaults.schemes[0]),
        ("--decoder", "decoders", decoder_name, "DECODER", "", "all"),
        ("--exposure", "exposures", number, "SYMBOLS", "", _format_list(defaults.exposures)),
        ("--snr", "decibels", number, "DB", "the chips' variance over that of a row's noise; ",
         _format_list(defaults.decibels)),
    ):  # fmt: skip
        parser.add_argument(
            flag, dest=field, action="append", type=kind, metavar=metavar,
            help=f"{meaning}may be repeated; default: {default}",
        )  # fmt: skip
    for field, (flag, metavar, meaning) in _NUMBERS.items():
        add_option(parser, flag, getattr(defaults, field), meaning, dest=field, metavar=metavar)
    add_option(parser, "--fps", FRAMES_A_SECOND, "pictures a second, one payload each")
    add_option(parser, "--seed", defaults.seed)
    parser.add_argument(
        "--out", type=Path, metavar="FOLDER", help="write bench.csv, bench.pdf and bench.png there"
    )
    parser.set_defaults(command=_run, writes={"out": folder_of_figures("bench")})


def _run(options: argparse.Namespace) -> int:
    names = tuple(dict.fromkeys(options.decoders or decoders()))
    schemes = tuple(dict.fromkeys(options.schemes or _DEFAULT_REQUEST.schemes))
    request = BenchRequest(
        schemes,
        names,
        tuple(options.exposures or _DEFAULT_REQUEST.exposures),
        tuple(options.decibels or _DEFAULT_REQUEST.decibels),
        seed=options.seed,
        **{field: getattr(options, field) for field in _NUMBERS},
    )
    check_bench(request)
    check_frame_rate(bench_scene(request, request.schemes[0]), options.fps)
    if options.out is not None:
        make_folder(options.out)  # refuse a folder before minutes of measurement
    with progress_bar(total=len(request.points), unit=" points", leave=False, delay=0.5) as bar:
        points = bench(request, lambda done, _all: bar.update(done - bar.n))
    for line in _table_lines(points, options.fps):
        print(line)
    if options.out is not None:
        from occ_model.figures.bench import write_bench  # slow to import

        write_bench(options.out, request, points, options.fps)
    return 0


def _table_lines(points: tuple[BenchPoint, ...], frames_a_second: float) -> list[str]:
    lines = ["scheme      decoder     exposure  SNR (dB)  bit error rate (95 % interval), bits/s"]
    for point in points:
        errors = point.errors
        lines.append(
            f"{point.scheme:<11} {errors.decoder:<11} {point.exposure:8g}  {point.decibels:8g}  "
            f"{errors.rate:.2g} ({errors.low:.2g} to {errors.high:.2g}), "
            f"{errors.bits_a_second(frames_a_second):,.0f}"
        )
    notes = {
        point.errors.decoder: point.note
        for point in points
        if point.errors.faults or not point.errors.pictures_right
    }
    lines += [f"{decoder}: {note}" for decoder, note in notes.items() if note]
    lines += dict.fromkeys(filter(None, (point.errors.why_above_half for point in points)))
    return lines


def _format_list(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:g}" for value in values)
