"""What things cost, as ratios measured side by side in one run.

``python tests/benchmarks/report.py`` prints the table; ``--markdown`` prints it for the README.
Absolute times differ from machine to machine and from hour to hour; a ratio of two things timed in
turn, in one process, does so much less. No test asserts a time.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter

import occ_model as occ

_ROUNDS = 41
_COLD_STARTS = 7
_FIRST_FRAME = Path(__file__).with_name("first_frame.py")


@dataclass(frozen=True)
class Row:
    """One line of the report."""

    what: str
    measured: str
    wanted: str


def side_by_side(*things: Callable[[], object], rounds: int = _ROUNDS) -> list[float]:
    """Time things in turn, round after round; return the median seconds of each."""
    times: list[list[float]] = [[] for _ in things]
    for thing in things:
        thing()
    for _ in range(rounds):
        for thing, seconds in zip(things, times, strict=True):
            start = perf_counter()
            thing()
            seconds.append(perf_counter() - start)
    return [median(seconds) for seconds in times]


def profile_cost() -> Row:
    """Compare a profile of very long exposures with one of short ones."""
    scene = occ.load_preset("phone-68us")
    short = scene.replace(exposure_time=0.5 * scene.transmitter.switching_period)
    long = scene.replace(exposure_time=10_000 * scene.transmitter.switching_period)
    a, b = side_by_side(
        lambda: occ.column_profile(long), lambda: occ.column_profile(short), rounds=401
    )
    return Row(
        f"profile of {scene.camera.columns} columns, t / t_LED = 10000 against 0.5",
        f"{a / b:.2f} ({1e3 * a:.3f} ms, {1e3 * b:.3f} ms)",
        "0.8 to 1.2",
    )


def frame_cost() -> Row:
    """Compare a full phone frame with a plain copy of it."""
    scene = occ.load_preset("phone-136us")
    image = occ.render(scene).image
    a, b = side_by_side(lambda: occ.render(scene), image.copy)
    return Row(
        "noise-free full phone frame against a plain copy of it",
        f"{a / b:.2f} ({1e3 * a:.2f} ms, {1e3 * b:.2f} ms)",
        "at most 6",
    )


def tilted_frame_cost() -> Row:
    """Compare a full phone frame with a tilted panel with a plain copy of it."""
    scene = occ.load_preset("phone-136us").replace(roll=0.3, yaw=0.3)
    image = occ.render(scene).image
    a, b = side_by_side(lambda: occ.render(scene), image.copy)
    return Row("the same with the panel tilted", f"{a / b:.2f} ({1e3 * a:.2f} ms)", "")


def decode_cost() -> Row:
    """Compare the decoding of a full phone frame with a plain copy of it."""
    scene = occ.load_preset("phone-136us")
    image = occ.render(scene).image
    a, b = side_by_side(lambda: occ.decode(image, scene), image.copy)
    return Row(
        "threshold decoding of a full phone frame against a plain copy of it",
        f"{a / b:.2f} ({1e3 * a:.2f} ms)",
        "at most 30",
    )


def profile_path_cost() -> Row:
    """Compare decoding the profile with decoding the image."""
    scene = occ.load_preset("phone-136us")
    frame = occ.render(scene)
    a, b = side_by_side(
        lambda: occ.decode(frame.image, scene), lambda: occ.decode(frame.enhanced, scene)
    )
    return Row(
        "decoding the image against the profile alone", f"{a / b:.2f} ({1e3 * b:.2f} ms)", ""
    )


def cold_start() -> Row:
    """Time from the start of Python to the first frame on the (offscreen) screen."""

    def run() -> None:
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        subprocess.run([sys.executable, str(_FIRST_FRAME)], check=True, env=environment)

    def bare() -> None:
        subprocess.run([sys.executable, "-c", "import PySide6.QtWidgets, numpy"], check=True)

    a, b = side_by_side(run, bare, rounds=_COLD_STARTS)
    return Row(
        "cold start to the first painted frame (whole process), against importing Qt and numpy",
        f"{a / b:.2f} ({a:.2f} s)",
        "under 1 s",
    )


_ALL = (profile_cost, frame_cost, tilted_frame_cost, decode_cost, profile_path_cost, cold_start)


def main() -> None:
    """Print the report."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--markdown", action="store_true", help="print a table for the README")
    markdown = parser.parse_args().markdown
    if markdown:
        print("| what | ratio (times) | wanted |\n|---|---|---|")
    for measure in _ALL:
        row = measure()
        if markdown:
            print(f"| {row.what} | {row.measured} | {row.wanted} |", flush=True)
        else:
            print(f"{row.what}\n    {row.measured}    {row.wanted}", flush=True)


if __name__ == "__main__":
    main()
