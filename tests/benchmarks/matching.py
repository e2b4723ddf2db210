"""How surely photos are explained: ``python tests/benchmarks/matching.py [what] [count] [first]``.

``--full`` does all of these in turn, with as many photos as stand here; ``first`` is the seed to
begin with. ``coverage``: how well stated errors hold, on 600 photos of a world that is wider than
the model; with ``--world lamps`` of single lamps as they are found in rooms, with ``--world
foreign`` of a camera with other optics and tone curves. ``negatives``: 400 pictures without stripes
of an LED. ``others``: 200 photos of another code than the scene's. ``unknown``: 300 photos of
unknown chips, 1.5 to 20 periods in view, half of them saturated.
``known`` (the default): 500 simulated photos with noise, vignetting, blur and JPEG of quality 60 to
95, of 4 to 30 columns a chip and exposures of a tenth of a chip to three. ``lamps``: how many lamps
are found in 200 pictures of one to eight (seeds below 1000 were looked at while the search was
made); ``hot-lamps``: of lamps with hot spots, halos and slopes, at exposures of 0.05 to 8 chips;
``rooms``: of small lamps in dark rooms.
``--plot FILE`` draws the errors of ``coverage`` beside their Cramer-Rao bounds.
"""

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from tqdm import tqdm

sys.path.insert(0, str(Path(__file__).parents[1]))

from both_cores import on_both_cores
from photo_trials import (
    Judgement,
    MatchErrors,
    judge_negative,
    judge_other_code,
    judge_unknown_chips,
    match_seed,
)
from photo_world.hot_lamps import hot_lamp_scene
from photo_world.lamp_scenes import LampScene, lamp_scene
from photo_world.lamp_scores import score_of
from photo_world.rooms import room_scene
from photo_world.trials import SATURATION_THIRDS, WORLDS, Trial

HEAD = (
    "| saturated | photos | sure | what | within 1 | within 2 | largest | median error | stated "
    "| bound | by light |\n|---|---|---|---|---|---|---|---|---|---|---|"
)

_SMALL = 9.95e-5

_WRONG = 0.01
"""Relative error of a readout time from which it is wrong."""


def row(name: str, found: list[Trial], what: str) -> str:
    """Write a line of the table, each fraction with its own standard deviation."""
    sure = [one for one in found if one.is_sure_of(what)]
    if not sure:
        return f"| {name} | {len(found)} | 0 | {what} | | | | | | | |"
    error = np.abs([getattr(one, f"{what}_error") for one in sure])
    stated = np.array([getattr(one, f"{what}_deviation") for one in sure])
    number = ("readout", "exposure").index(what)
    bounds = np.array([(one.picture_bounds[number], one.light_bounds[number]) for one in sure])
    off = error / stated
    # The median of an error is 0.674 of its standard deviation.
    fractions = (np.median(error), np.median(stated), *(0.674 * np.median(bounds, axis=0)))
    return (
        f"| {name} | {len(found)} | {len(sure)} | {what} | {within(off, 1.0)} | "
        f"{within(off, 2.0)} | {off.max():.1f} | " + " | ".join(map(as_fraction, fractions)) + " |"
    )


def as_fraction(value: float) -> str:
    """Write a fraction in percent, a very small one in parts in a million."""
    return f"{1e6 * value:.2g} ppm" if value < _SMALL else f"{100.0 * value:.2g} %"


def within(off: np.ndarray, most: float) -> str:
    """Return the fraction of errors below some deviations, and by how much chance changes it."""
    fraction = float(np.mean(off < most))
    # By Agresti and Coull's estimate, which is not 0 where all are (Am. Stat. 52:119, 1998).
    likely = (fraction * len(off) + 2.0) / (len(off) + 4.0)
    chance = np.sqrt(likely * (1.0 - likely) / (len(off) + 4.0))
    return f"{100.0 * fraction:.0f} ± {100.0 * chance:.0f} %"


def told(found: list[Trial]) -> list[str]:
    """Count the verdicts, name what is surely wrong, and write the table."""
    wrong = [one for one in found if one.is_sure and abs(one.readout_error) > _WRONG]
    refused, sure = sum(bool(one.failure) for one in found), sum(one.is_sure for one in found)
    return [
        f"sure: {sure}, doubtful: {len(found) - sure - refused}, refused: {refused}",
        f"sure, and wrong by more than {100.0 * _WRONG:g} %: {len(wrong)}",
        *(f"  seed {one.seed}: by {100.0 * one.readout_error:.2g} %" for one in wrong),
        *duties(found),
        *table(found),
    ]


def duties(found: list[Trial]) -> list[str]:
    """Report the errors of the duties of pulses, and how many that were given are wrong."""
    sure = [one for one in found if one.is_sure_of("exposure") and np.isfinite(one.duty_error)]
    measured = [one for one in sure if np.isfinite(one.duty_deviation)]
    off = np.abs([one.duty_error / one.duty_deviation for one in measured])
    told_wrong = sum(abs(one.duty_error) > _WRONG for one in sure if one not in measured)
    lines = [
        f"sure pulses taken for the one told: {len(sure) - len(measured)}, wrongly {told_wrong}"
    ]
    if measured:
        lines.append(
            f"duties measured: {len(measured)}, within 1: {within(off, 1.0)}, within 2: "
            f"{within(off, 2.0)}, largest {off.max():.1f}"
        )
    return lines


def table(found: list[Trial]) -> list[str]:
    """Write the table: each third of the saturated fraction, and all."""
    lines = [HEAD]
    for low, high in pairwise(SATURATION_THIRDS):
        part = [one for one in found if low <= one.saturated < high]
        name = f"{100.0 * low:.0f} to {100.0 * high:.0f} %"
        lines += [row(name, part, what) for what in ("readout", "exposure")]
    return [*lines, *(row("all", found, what) for what in ("readout", "exposure"))]


def plot(found: list[Trial], path: Path) -> None:
    """Draw each sure error, and what is stated, over the Cramer-Rao bound."""
    figure = Figure((9.0, 4.4), layout="constrained")
    for axes, what in zip(figure.subplots(1, 2), ("readout", "exposure"), strict=True):
        sure = [one for one in found if one.is_sure_of(what)]
        number = ("readout", "exposure").index(what)
        bound = np.array([one.picture_bounds[number] for one in sure])
        stated = np.array([getattr(one, f"{what}_deviation") for one in sure])
        error = np.abs([getattr(one, f"{what}_error") for one in sure])
        ends = np.array([bound.min(), bound.max()])
        axes.loglog(bound, stated, "o", ms=4, mfc="none", color="#c05000", label="stated deviation")
        axes.loglog(bound, error, ".", ms=5, color="#1f6fb4", label="error")
        axes.loglog(ends, ends, "-", color="0.2", lw=1.5, label="Cram\u00e9r-Rao bound")
        axes.set_xlabel("bound of the standard deviation, relative")
        axes.set_title(f"{what} time, {len(sure)} photographs")
        axes.grid(visible=True, alpha=0.25)
        axes.legend(loc="lower right")
        axes.set_ylim(bottom=0.05 * bound.min())
    figure.axes[0].set_ylabel("error, relative")
    figure.savefig(path, dpi=110)


def line(what: str, errors: list[float], allowed: float) -> str:
    """Say how large errors are in the median, and how many are within the limit."""
    within = 100.0 * np.mean(np.array(errors) < allowed)
    return (
        f"{what}: median {100.0 * float(np.median(errors)):.2g} %, within {100.0 * allowed:g} %: "
        f"{within:.1f} % of {len(errors)}"
    )


def report(found: list[MatchErrors]) -> list[str]:
    """Say how exactly the photos were explained."""
    long = [one for one in found if one.exposure_in_chips > 0.5]
    short = [one for one in found if one.exposure_in_chips <= 0.5]
    lines = [
        line("readout time", [one.readout_error for one in found], 0.002),
        line("exposure of more than half a chip", [one.exposure_error for one in long], 0.05),
        line("exposure of less", [one.exposure_error for one in short], 0.05),
    ]
    sure = [one.readout_error for one in found if one.is_sure]
    lines.append(f"sure: {len(sure)} of {len(found)} ({100.0 * len(sure) / len(found):.1f} %)")
    if sure:
        lines.append(line("readout time of what is sure", sure, 0.002))
    lines += [
        f"  doubtful, photo {one.seed}: {' '.join(one.doubts)}" for one in found if one.doubts
    ]
    failures = [one for one in found if one.failure]
    lines.append(f"not explained: {len(failures)}")
    lines += [f"  photo {one.seed}: {one.failure}" for one in failures]
    return lines


def tally(said: list[Judgement]) -> list[str]:
    """Count the verdicts, and quote those that are not a refusal or not right."""
    count = len(said)
    lines = []
    for verdict in ("sure", "doubtful", "refused"):
        these = [one for one in said if one.verdict == verdict]
        right = sum(one.is_right for one in these)
        is_scene_pattern = sum(one.is_scene_pattern for one in these)
        lines.append(
            f"{verdict}: {len(these)} of {count} ({100.0 * len(these) / count:.1f} %), {right} of "
            f"them with the chips sent, {is_scene_pattern} with the scene's"
        )
    wrong = [one for one in said if not one.is_right and one.verdict != "refused"]
    missed = [one for one in said if one.what != "other code" and one.verdict == "refused"]
    quoted = wrong + (missed if any(one.is_right for one in said) else [])
    return lines + [f"  {one.what} {one.seed}: {one.verdict}. {one.why}" for one in quoted]


def lamps_of(draw: Callable[[int], LampScene], seeds: Sequence[int]) -> list[str]:
    return score_of(seeds, draw).lines()


WHAT: dict[str, tuple[int, Callable[[Sequence[int]], Iterable[Any]], Callable[..., list[str]]]] = {
    "coverage": (600, WORLDS["wide"], told),
    "negatives": (400, partial(on_both_cores, judge_negative), tally),
    "others": (200, partial(on_both_cores, judge_other_code), tally),
    "unknown": (300, partial(on_both_cores, judge_unknown_chips), tally),
    "known": (500, partial(on_both_cores, match_seed), report),
    "lamps": (200, partial(lamps_of, lamp_scene), list),
    "hot-lamps": (200, partial(lamps_of, hot_lamp_scene), list),
    "rooms": (200, partial(lamps_of, room_scene), list),
}
"""The full number of photographs, how they are matched, and how the result is written."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", nargs="?", choices=list(WHAT), default="known")
    parser.add_argument("count", nargs="?", type=int, help="number of photographs")
    parser.add_argument("first", nargs="?", type=int, default=0, help="seed to begin with")
    parser.add_argument("--full", action="store_true", help="everything, as many as are asked for")
    parser.add_argument("--world", choices=list(WORLDS), default="wide", help="of coverage")
    parser.add_argument("--plot", type=Path, help="picture of the errors of coverage")
    words = parser.parse_args()
    for what in WHAT if words.full else [words.what]:
        most, match, tell = WHAT[what]
        if what == "coverage":
            match = WORLDS[words.world]
        count = most if words.full or words.count is None else words.count
        found = match(range(words.first, words.first + count))
        results = list(tqdm(found, what, count))
        seeds = f"{what}, seeds {words.first} to {words.first + count - 1}"
        print("\n".join([seeds, *tell(results)]), flush=True)
        if what == "coverage" and words.plot:
            plot(results, words.plot)


if __name__ == "__main__":
    main()
