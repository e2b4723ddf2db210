"""The command ``occ-model film-study``: packets received against frequency, gap and length."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from occ_model.commands.files import folder_of_figures
from occ_model.commands.options import (
    Commands,
    add_option,
    add_scene_options,
    decoder_name,
    progress_bar,
    scene_of,
    whole_number,
)
from occ_model.errors import ParameterError, one_line, quote
from occ_model.files.writing import make_folder
from occ_model.results.decoding import PAPER_DECODER
from occ_model.scene.parameters import quantity
from occ_model.scene.units import HERTZ
from occ_model.study.film_study import (
    FilmPoint,
    FilmRequest,
    example_request,
    film_study,
    published_rule,
    scene_of_films,
)

_FRAMES = 120

Number = TypeVar("Number", int, float)


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "film-study", help="measure what films carry, against frequency, gap and packet length"
    )
    add_scene_options(parser)
    add_option(parser, "--frequencies", "4kHz,8kHz", "switching frequencies", metavar="LIST")
    add_option(
        parser, "--gaps", "5,10,20,30,40", "gaps in percent of a frame period", metavar="LIST"
    )
    add_option(parser, "--bits", "16,64", "bits of a payload", metavar="LIST")
    add_option(parser, "--frame-rate", 30.0, metavar="HZ")
    parser.add_argument(
        "--frames", type=whole_number, metavar="N", help=f"frames of each film; default: {_FRAMES}"
    )
    parser.add_argument(
        "--decoder", type=decoder_name, default=PAPER_DECODER, help="default: %(default)s"
    )
    add_option(parser, "--seed", 1)
    parser.add_argument(
        "--example", action="store_true",
        help="measure the published example of CamComSim beside counting and its own rule",
    )  # fmt: skip
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="folder for the figure as PDF, PNG, SVG and CSV"
    )
    parser.set_defaults(command=_run, writes={"out": folder_of_figures("films")})


def _run(options: argparse.Namespace) -> int:
    request = _example_of(options) if options.example else _request_of(options)
    if options.out:
        make_folder(options.out)  # refuse a folder before minutes of measurement
    points = []
    print("   frequency    gap   bits  packets  received  by counting  with repeats")
    with progress_bar(total=request.point_count * request.frames, unit="frame") as bar:
        for point in film_study(request, bar.update):
            points.append(point)
            bar.write(_format_point(point), file=sys.stdout)
    if options.example:
        print(
            f"CamComSim states no figure; by its own rule {100.0 * float(published_rule()):.2f} % "
            "are received."
        )
    if options.out:
        # Only figures need Matplotlib, whose import takes half a second.
        from occ_model.figures.films import write_films_figure

        write_films_figure(options.out, request, points)
        print(f"{one_line(str(options.out))}: the figure as PDF, PNG, SVG and CSV")
    return 0


def _example_of(options: argparse.Namespace) -> FilmRequest:
    request = example_request(seed=options.seed)
    frames = request.frames if options.frames is None else options.frames
    return replace(request, frames=frames, decoder=options.decoder)


def _request_of(options: argparse.Namespace) -> FilmRequest:
    frequency = quantity("switching_frequency")
    return FilmRequest(
        scene_of_films(scene_of(options)),
        frequencies=tuple(frequency.parse(text) for text in options.frequencies.split(",")),
        gaps=tuple(gap / 100.0 for gap in _parse_numbers("gaps", options.gaps, float, "numbers")),
        bits=_parse_numbers("bits", options.bits, int, "whole numbers"),
        frame_rate=options.frame_rate,
        frames=_FRAMES if options.frames is None else options.frames,
        decoder=options.decoder,
        seed=options.seed,
    )


def _parse_numbers(name: str, text: str, kind: type[Number], allowed: str) -> tuple[Number, ...]:
    numbers = []
    for part in text.split(","):
        try:
            numbers.append(kind(part))
        except ValueError:
            raise ParameterError(f"{name} has {quote(part)}; allowed: {allowed}.") from None
    return tuple(numbers)


def _format_point(point: FilmPoint) -> str:
    failure = "" if point.is_right else point.failure or "The payload is wrong."
    note = "".join(f"  {text}" for text in (failure, point.faults) if text)
    received, counted = 100.0 * point.reception, 100.0 * point.counted_reception
    return (
        f"{HERTZ.format(point.frequency):>12} {100.0 * point.gap:5.1f} % {point.bits:5d} "
        f"{point.packets:8d} {received:7.2f} % {counted:9.2f} % "
        f"{point.bits_per_second:14,.0f}{note}"
    )
