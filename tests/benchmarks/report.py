"""What things cost, as ratios measured side by side in one run.

``resources/docs/validation.md`` has most of the times. Absolute times differ from machine to
machine and from hour to hour; a ratio of two things timed in turn, in one process, does so much
less. No test asserts a time.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from itertools import count
from math import inf
from pathlib import Path

from costs import (
    MEMORY,
    Row,
    film_decoding_cost,
    film_frame_cost,
    film_memory,
    many_lamps_cost,
    match_cost,
    reading_cost,
    side_by_side,
    sweep_cost,
)

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.camera import exposure
from occ_model.camera.enhancement import enhance
from occ_model.light import sent, times
from occ_model.receiver.matched.templates import make_code_templates
from occ_model.results.frame import Frame
from occ_model.scene.scene import Scene

_COLD_STARTS = 7
_FIRST_FRAME = Path(__file__).with_name("first_frame.py")


def _new_profile(scene: Scene) -> FloatArray:
    """Compute the column profile of a scene of which nothing is known yet."""
    for cached in {**vars(exposure), **vars(sent), **vars(times)}.values():
        if hasattr(cached, "cache_clear"):
            cached.cache_clear()
    return occ.column_profile(scene)


_PAPER, _WITH_LENS = occ.load_preset("phone-136us"), occ.load_preset("phone-136us-real")


def _ratio(
    what: str, wanted: str, work: Callable[[], object], other: Callable[[], object], **how: int
) -> Row:
    """Compare a work with another one."""
    a, b = side_by_side(work, other, **how)
    return Row(what, f"{a / b:.2f} ({a:.2f} ms)", wanted)


def profile_cost() -> Row:
    scene = occ.load_preset("phone-68us")
    short = scene.replace(exposure_time=0.5 * scene.transmitter.switching_period)
    long = scene.replace(exposure_time=10_000 * scene.transmitter.switching_period)
    a, b = side_by_side(lambda: _new_profile(long), lambda: _new_profile(short), rounds=401)
    return Row(
        f"profile of {scene.camera.columns} columns, t / t_LED = 10000 against 0.5",
        f"{a / b:.2f} ({a:.3f} ms, {b:.3f} ms)",
        "0.8 to 1.2",
    )


def frame_cost() -> Row:
    image = occ.render(_PAPER, tolerance=inf).image
    start = count()
    # Each time another scene, as while a slider moves.
    return _ratio(
        "noise-free full phone frame against a plain copy of it", "at most 6",
        lambda: occ.render(_PAPER.replace(start_time=1e-7 * next(start)), tolerance=inf),
        image.copy,
    )  # fmt: skip


def tilted_frame_cost() -> Row:
    scene = _PAPER.replace(roll=0.3, yaw=0.3)
    image = occ.render(scene, tolerance=inf).image
    return _ratio(
        "the same with the panel tilted", "", lambda: occ.render(scene, tolerance=inf), image.copy
    )


def noise_cost() -> Row:
    image = occ.render(_PAPER).image
    return _ratio(
        "the same with the sensor's noise", "at most 20", lambda: occ.render(_PAPER), image.copy
    )


def complete_cost() -> Row:
    image = occ.render(_WITH_LENS).image
    return _ratio(
        "the same with all ten effects", "at most 100",
        lambda: occ.render(_WITH_LENS, tolerance=0.0), image.copy,
    )  # fmt: skip


def draft_cost() -> Row:
    image = occ.render(_WITH_LENS).image
    start = count()

    def draft(rows_step: int) -> Frame:
        # Each time another scene, as while a slider moves.
        moved = _WITH_LENS.replace(start_time=1e-7 * next(start))
        return occ.render(moved, tolerance=0.0, rows_step=rows_step)

    a, b, finer = side_by_side(lambda: draft(9), image.copy, lambda: draft(5))
    return Row(
        "a draft of every ninth row of it, with all ten effects",
        f"{a / b:.0f} ({a:.1f} ms; every fifth row {finer:.1f} ms)",
        "under 33 ms",
    )


def planning_cost() -> Row:
    """Compare both plans of a slider's movement with a noise-free picture."""
    start = count()

    def plans() -> None:
        moved = _WITH_LENS.replace(start_time=1e-7 * next(start))
        occ.plan(moved, observable="image")
        occ.plan(moved, observable="signal")

    return _ratio(
        "its plans for picture and signal, against a noise-free frame", "",
        plans, lambda: occ.render(_PAPER, tolerance=inf), rounds=21,
    )  # fmt: skip


def complete_memory() -> Row:
    command = [sys.executable, str(MEMORY), "picture", "phone-136us-real"]
    frames = float(subprocess.run(command, check=True, capture_output=True).stdout)
    return Row("its peak memory, in bytes of the frame", f"{frames:.1f}", "at most 7")


def decode_cost() -> Row:
    image = occ.render(_PAPER, tolerance=inf).image
    return _ratio(
        "threshold decoding of a full phone frame against a plain copy of it", "at most 30",
        lambda: occ.decode(image, _PAPER), image.copy,
    )  # fmt: skip


def _read_by_profile(scene: Scene) -> None:
    occ.decode(enhance(_new_profile(scene), scene.model.enhancement), scene)


def profile_cost_with_reading() -> Row:
    return _ratio(
        "profile simulated and read by threshold, against simulating it alone", "under 0.5 ms",
        lambda: _read_by_profile(_PAPER), lambda: _new_profile(_PAPER), rounds=401,
    )  # fmt: skip


def profile_path_cost() -> Row:
    return _ratio(
        "the same by way of the image, against by way of the profile", "",
        lambda: occ.decode(occ.render(_PAPER, tolerance=inf).image, _PAPER),
        lambda: _read_by_profile(_PAPER),
    )  # fmt: skip


def matched_cost() -> Row:
    profile = enhance(occ.column_profile(_PAPER), _PAPER.model.enhancement)
    return _ratio(
        "matched decoding of a profile against threshold decoding", "under 2 ms",
        lambda: occ.decode(profile, _PAPER, "matched"),
        lambda: occ.decode(profile, _PAPER, "threshold"), rounds=201,
    )  # fmt: skip


def code_templates_cost() -> Row:
    profile = enhance(occ.column_profile(_PAPER), _PAPER.model.enhancement)
    exposures = (Fraction(n, 977) for n in count(1000))
    return _ratio(
        "forward model of all 1024 codes, once a setting, against one matched decoding", "",
        lambda: make_code_templates(10, next(exposures)),
        lambda: occ.decode(profile, _PAPER, "matched"),
    )  # fmt: skip


def long_code_cost() -> Row:
    scene = _PAPER.replace(switching_frequency=20e3)
    long = scene.replace(bits=16, code=54321)
    profile, long_profile = occ.column_profile(scene), occ.column_profile(long)
    exposures = (Fraction(n, 977) for n in count(1000))
    a, b, templates = side_by_side(
        lambda: occ.decode(long_profile, long, "matched"),
        lambda: occ.decode(profile, scene, "matched"),
        lambda: make_code_templates(16, next(exposures)),
    )
    return Row(
        "matched decoding of a code of 16 bits, against one of 10",
        f"{a / b:.0f} ({a:.0f} ms; templates of all 65,536 codes {templates:.0f} ms)",
        "under 0.5 s",
    )


def cold_start() -> Row:
    """Time from the start of Python to the first frame on the (offscreen) screen."""

    def run() -> None:
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        # Compiled files are kept, as they are for whoever has not forbidden it to Python.
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        subprocess.run([sys.executable, str(_FIRST_FRAME)], check=True, env=environment)

    def bare() -> None:
        subprocess.run([sys.executable, "-c", "import PySide6.QtWidgets, numpy"], check=True)

    a, b = side_by_side(run, bare, rounds=_COLD_STARTS)
    return Row(
        "cold start to the first painted frame, against importing Qt and numpy",
        f"{a / b:.2f} ({1e-3 * a:.2f} s)",
        "under 1 s",
    )


_ALL = (
    profile_cost,
    frame_cost,
    tilted_frame_cost,
    noise_cost,
    complete_cost,
    complete_memory,
    planning_cost,
    draft_cost,
    decode_cost,
    profile_cost_with_reading,
    profile_path_cost,
    matched_cost,
    code_templates_cost,
    long_code_cost,
    match_cost,
    reading_cost,
    film_frame_cost,
    film_decoding_cost,
    film_memory,
    many_lamps_cost,
    sweep_cost,
    cold_start,
)


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    for measure in _ALL:
        row = measure()
        print(f"{row.what}\n    {row.measured}    {row.wanted}", flush=True)


if __name__ == "__main__":
    main()
