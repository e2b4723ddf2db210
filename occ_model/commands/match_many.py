"""The command ``occ-model match`` with several photos, which give one readout time."""

import argparse
from dataclasses import replace
from pathlib import Path

from occ_model.commands.bars import run_with_bar
from occ_model.commands.files import SCENE_FILE, TABLE, OutputFiles
from occ_model.commands.options import is_stated, whole_number
from occ_model.errors import ParameterError, inflect, one_line
from occ_model.files.writing import write_whole
from occ_model.photo.many.match_photos import MOST_JOBS, Progress, match_photos, usual_jobs
from occ_model.photo.many.other_programs import format_lines, frame_readout_time
from occ_model.program import EXIT_FAILURE, EXIT_INTERRUPTED
from occ_model.results.match import known_parameter, known_value
from occ_model.results.match_sentence import estimate_text
from occ_model.results.photo_table import (
    DOUBTFUL,
    SURE,
    VERDICTS,
    CombinedEstimate,
    PhotoRow,
    PhotoTable,
    assumption,
    csv_text,
)
from occ_model.scene.argument_checks import check_count
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

_MAX_FILE_CHARACTERS = 32


def add_many_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("more", nargs="*", type=Path, metavar="file", help=argparse.SUPPRESS)
    parser.add_argument(
        "--jobs",
        type=whole_number,
        metavar="N",
        help="processes for several photos; default: one for each core",
    )
    parser.add_argument(
        "--known",
        action="append",
        default=[],
        metavar="PHOTO=VALUE",
        help="the known value for one of several photos, such as garage.jpg=2kHz: the "
        "frequency of its lamp, stated as for the others, or the readout time of its camera",
    )


def run_many(options: argparse.Namespace, scene: Scene) -> int:
    """Match several photos, print their table, and write it to ``--out``."""
    paths = [options.file, *options.more]
    jobs = usual_jobs() if options.jobs is None else options.jobs
    check_count("jobs", jobs, 1, MOST_JOBS)
    own_values = _parse_known(paths, scene, options)

    def run(progress: Progress) -> PhotoTable:
        return match_photos(
            paths,
            scene,
            estimate=options.estimate,
            sent=options.sent,
            fit_gamma=options.fit_gamma,
            scan_axis=options.scan_axis,
            channel=options.channel,
            known=own_values,
            jobs=jobs,
            progress=progress,
        )

    table = run_with_bar(run, "photo", "nothing was written.", leave=False)
    if table is None:
        return EXIT_INTERRUPTED
    is_assumed = table.rests_on_the_scene and not is_stated(table.known, options)
    known = assumption(*known_value(table.estimate, table.scene)) if is_assumed else ""
    paste_lines = format_lines(table, known)
    if options.out:
        write_whole(options.out, csv_text(table, paste_lines, known).encode("utf-8"))
    for line in [*_report_lines(table, known), *paste_lines]:
        print(line)
    if options.out:
        print(f"{one_line(str(options.out))}: {inflect(len(table.rows), 'photo')}")
    return EXIT_FAILURE if table.estimated is None else 0


def _parse_known(paths: list[Path], scene: Scene, options: argparse.Namespace) -> dict[int, float]:
    """Parse the known values of single photos, by index."""
    known: dict[int, float] = {}
    declared = quantity(known_parameter(options.estimate, scene.transmitter))
    for text in options.known:
        name, _, value = text.rpartition("=")
        indices = _find_photo(name, paths)
        number = replace(declared, name=f"--known {one_line(name)}").parse(value)
        if not known.keys().isdisjoint(indices):
            raise ParameterError(
                f"--known {one_line(name)} is given again, as {one_line(value)}; allowed: one "
                "value for a photo."
            )
        known |= dict.fromkeys(indices, number)
    return known


def _find_photo(name: str, paths: list[Path]) -> list[int]:
    """Return a photo's indices among those given, by its path or by its file name alone."""
    for names in ([str(path) for path in paths], [path.name for path in paths]):
        indices = [index for index, each in enumerate(names) if each == name]
        if len({paths[index] for index in indices}) == 1:
            return indices
    raise ParameterError(
        f"--known {one_line(name) or '(nothing)'} is not exactly one of the photos; allowed: "
        f"PHOTO=VALUE with the path of one, such as {one_line(str(paths[0]))}=1kHz."
    )


def _report_lines(table: PhotoTable, known: str) -> list[str]:
    name = table.estimate
    width = min(max(len(one_line(row.path.name)) for row in table.rows), _MAX_FILE_CHARACTERS)
    lines = [
        f"{_shorten(row.path.name, width):{width}}  {row.verdict:10}  {_estimates_text(row, name)}"
        + (f"  given: {quantity(table.known).format(row.given)}" if row.given is not None else "")
        + ("  outlier" if table.is_outlier(index) else "")
        + (f"  {row.note}" if row.note else "")
        for index, row in enumerate(table.rows)
    ]
    counts = ", ".join(
        f"{table.count(verdict)} {verdict}" for verdict in VERDICTS if table.count(verdict)
    )
    lines += ["", f"{'photos':22}{len(table.rows)}: {counts}"]
    lines += _mean_lines(name, table.estimated, known)
    lines += _mean_lines("exposure_time", table.exposure_time, known)
    frame = frame_readout_time(table)
    if frame is not None:
        lines.append(
            f"{'readout of the frame':22}{known}{_format_estimate('readout_time', *frame)}"
        )
    return lines + list(table.notes)


def _estimates_text(row: PhotoRow, name: str) -> str:
    texts = []
    for each in (name, "exposure_time"):
        value, error = getattr(row, each), row.uncertainty(each)
        texts.append("" if value is None else _format_estimate(each, value, error or 0.0))
    # In a doubtful photo everything is doubtful.
    if row.verdict == SURE and row.exposure_verdict == DOUBTFUL:
        texts[1] += " (doubtful)"
    return f"{texts[0]:24}  {texts[1]:22}".rstrip()


def _mean_lines(name: str, mean: CombinedEstimate | None, known: str) -> list[str]:
    if mean is None:
        return []
    text = f"{known}{_format_estimate(name, mean.value, mean.uncertainty)}, mean of {mean.count}"
    if mean.count > 1:
        text += f"; chi-square {mean.chi_square:.3g} of {mean.degrees_of_freedom}: " + (
            "they agree" if mean.agrees else "they differ by more than their errors"
        )
    if mean.outliers:
        text += f"; {len(mean.outliers)} excluded as too far from the others"
    return [f"{name:22}{text}"]


def _format_estimate(name: str, value: float, error: float) -> str:
    return estimate_text(quantity(name), value, error)


def _shorten(text: str, width: int) -> str:
    line = one_line(text)
    return line if len(line) <= width else f"…{line[1 - width :]}"


def outputs_of_match(options: argparse.Namespace) -> OutputFiles:
    """Return the output of ``--out``: the table of several photos, or the scene of one."""
    return TABLE if options.more else SCENE_FILE
