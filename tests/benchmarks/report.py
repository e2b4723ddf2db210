"""What things cost, as ratios measured side by side in one run.

``resources/docs/validation.md`` has most of the times. Absolute times differ from machine to
machine and from hour to hour; a ratio of two things timed in turn, in one process, does so much
less. No test asserts a time.
"""

import argparse
import os
import subprocess
import sys
from fractions import Fraction
from itertools import count
from math import inf
from pathlib import Path

from costs import ROWS, peak_memory, ratio, row, side_by_side

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
_PAPER, _WITH_LENS = occ.load_preset("phone-136us"), occ.load_preset("phone-136us-real")
_BARE = occ.render(_PAPER, tolerance=inf).image


def _new_profile(scene: Scene) -> FloatArray:
    """Compute the column profile of a scene of which nothing is known yet."""
    for cached in {**vars(exposure), **vars(sent), **vars(times)}.values():
        if hasattr(cached, "cache_clear"):
            cached.cache_clear()
    return occ.column_profile(scene)


def _read_by_profile(scene: Scene) -> None:
    occ.decode(enhance(_new_profile(scene), scene.model.enhancement), scene)


@row("profile of a phone's columns, t / t_LED = 10000 against 0.5", "0.8 to 1.2")
def compare_exposures() -> str:
    scene = occ.load_preset("phone-68us")
    short = scene.replace(exposure_time=0.5 * scene.transmitter.switching_period)
    long = scene.replace(exposure_time=10_000 * scene.transmitter.switching_period)
    return ratio(lambda: _new_profile(long), lambda: _new_profile(short), rounds=401)


@row("noise-free full phone frame against a plain copy of it", "at most 6")
def compare_frame() -> str:
    start = count()
    # Each time another scene, as while a slider moves.
    return ratio(
        lambda: occ.render(_PAPER.replace(start_time=1e-7 * next(start)), tolerance=inf),
        _BARE.copy,
    )


@row("the same with the panel tilted")
def compare_tilted_frame() -> str:
    return ratio(lambda: occ.render(_PAPER.replace(roll=0.3, yaw=0.3), tolerance=inf), _BARE.copy)


@row("the same with the sensor's noise", "at most 20")
def compare_noise() -> str:
    return ratio(lambda: occ.render(_PAPER), _BARE.copy)


@row("the same with all ten effects", "at most 100")
def compare_complete_frame() -> str:
    return ratio(lambda: occ.render(_WITH_LENS, tolerance=0.0), _BARE.copy)


@row("its peak memory, in bytes of the frame", "at most 7")
def measure_memory() -> str:
    (frames,) = peak_memory("picture", "phone-136us-real")
    return f"{frames:.1f}"


@row("its plans for picture and signal, against a noise-free frame")
def compare_plans() -> str:
    """Compare both plans of a slider's movement."""
    start = count()

    def plan_both() -> None:
        moved = _WITH_LENS.replace(start_time=1e-7 * next(start))
        occ.plan(moved, observable="image")
        occ.plan(moved, observable="signal")

    return ratio(plan_both, lambda: occ.render(_PAPER, tolerance=inf), rounds=21)


@row("a draft of every ninth row of it, with all ten effects", "under 33 ms")
def compare_draft() -> str:
    start = count()

    def draft(rows_step: int) -> Frame:
        # Each time another scene, as while a slider moves.
        moved = _WITH_LENS.replace(start_time=1e-7 * next(start))
        return occ.render(moved, tolerance=0.0, rows_step=rows_step)

    a, b, finer = side_by_side(lambda: draft(9), _BARE.copy, lambda: draft(5))
    return f"{a / b:.0f} ({a:.1f} ms; every fifth row {finer:.1f} ms)"


@row("threshold decoding of a full phone frame against a plain copy of it", "at most 30")
def compare_decoding() -> str:
    return ratio(lambda: occ.decode(_BARE, _PAPER), _BARE.copy)


@row("profile simulated and read by threshold, against simulating it alone", "under 0.5 ms")
def compare_reading() -> str:
    return ratio(lambda: _read_by_profile(_PAPER), lambda: _new_profile(_PAPER), rounds=401)


@row("the same by way of the image, against by way of the profile")
def compare_paths() -> str:
    return ratio(
        lambda: occ.decode(occ.render(_PAPER, tolerance=inf).image, _PAPER),
        lambda: _read_by_profile(_PAPER),
    )


@row("matched decoding of a profile against threshold decoding", "under 2 ms")
def compare_matched_decoding() -> str:
    profile = enhance(occ.column_profile(_PAPER), _PAPER.model.enhancement)
    return ratio(
        lambda: occ.decode(profile, _PAPER, "matched"),
        lambda: occ.decode(profile, _PAPER, "threshold"),
        rounds=201,
    )


@row("forward model of all 1024 codes, once a setting, against one matched decoding")
def compare_templates() -> str:
    profile = enhance(occ.column_profile(_PAPER), _PAPER.model.enhancement)
    exposures = (Fraction(n, 977) for n in count(1000))
    return ratio(
        lambda: make_code_templates(10, next(exposures)),
        lambda: occ.decode(profile, _PAPER, "matched"),
    )


@row("matched decoding of a code of 16 bits, against one of 10", "under 0.5 s")
def compare_long_codes() -> str:
    scene = _PAPER.replace(switching_frequency=20e3)
    long = scene.replace(bits=16, code=54321)
    profile, long_profile = occ.column_profile(scene), occ.column_profile(long)
    exposures = (Fraction(n, 977) for n in count(1000))
    a, b, templates = side_by_side(
        lambda: occ.decode(long_profile, long, "matched"),
        lambda: occ.decode(profile, scene, "matched"),
        lambda: make_code_templates(16, next(exposures)),
    )
    return f"{a / b:.0f} ({a:.0f} ms; templates of all 65,536 codes {templates:.0f} ms)"


@row("cold start to the first painted frame, against importing Qt and numpy", "under 1 s")
def compare_cold_start() -> str:
    """Time from the start of Python to the first frame on the (offscreen) screen."""
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    # Compiled files are kept, as they are for whoever has not forbidden it to Python.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    first, bare = [str(_FIRST_FRAME)], ["-c", "import PySide6.QtWidgets, numpy"]
    return ratio(
        lambda: subprocess.run([sys.executable, *first], check=True, env=environment),
        lambda: subprocess.run([sys.executable, *bare], check=True),
        rounds=_COLD_STARTS,
    )


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    for measure, (what, wanted) in ROWS.items():
        print(f"{what}\n    {measure()}    {wanted}", flush=True)


if __name__ == "__main__":
    main()
