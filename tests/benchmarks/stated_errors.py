"""How well stated errors hold: the true values within one and two standard deviations."""

from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from photo_world.trials import SATURATION_THIRDS, Trial

HEAD = (
    "| saturated | photos | sure | what | within 1 | within 2 | largest | median error | stated "
    "| bound | by light |\n|---|---|---|---|---|---|---|---|---|---|---|"
)

_SMALL = 9.95e-5

_WRONG = 0.01
"""Relative error of a readout time from which it is wrong."""


def row(name: str, found: list[Trial], what: str) -> str:
    """Write a line of the table, each share with its own standard deviation."""
    sure = [one for one in found if one.is_sure_of(what)]
    if not sure:
        return f"| {name} | {len(found)} | 0 | {what} | | | | | | | |"
    error = np.abs([getattr(one, what) for one in sure])
    stated = np.array([getattr(one, f"{what}_deviation") for one in sure])
    number = ("readout", "exposure").index(what)
    bounds = np.array([(one.picture_bounds[number], one.light_bounds[number]) for one in sure])
    off = error / stated
    # The median of an error is 0.674 of its standard deviation.
    shares = (np.median(error), np.median(stated), *(0.674 * np.median(bounds, axis=0)))
    return (
        f"| {name} | {len(found)} | {len(sure)} | {what} | {within(off, 1.0)} | "
        f"{within(off, 2.0)} | {off.max():.1f} | " + " | ".join(map(as_share, shares)) + " |"
    )


def as_share(value: float) -> str:
    """Write a share in percent, a very small one in parts in a million."""
    return f"{1e6 * value:.2g} ppm" if value < _SMALL else f"{100.0 * value:.2g} %"


def within(off: np.ndarray, most: float) -> str:
    """Return the fraction of errors below some deviations, and by how much chance changes it."""
    share = float(np.mean(off < most))
    # By Agresti and Coull's estimate, which is not 0 where all are (Am. Stat. 52:119, 1998).
    likely = (share * len(off) + 2.0) / (len(off) + 4.0)
    chance = np.sqrt(likely * (1.0 - likely) / (len(off) + 4.0))
    return f"{100.0 * share:.0f} ± {100.0 * chance:.0f} %"


def told(found: list[Trial]) -> list[str]:
    """Count the verdicts, name what is surely wrong, and write the table."""
    wrong = [one for one in found if one.is_sure and abs(one.readout) > _WRONG]
    refused, sure = sum(bool(one.failure) for one in found), sum(one.is_sure for one in found)
    return [
        f"sure: {sure}, doubtful: {len(found) - sure - refused}, refused: {refused}",
        f"sure, and wrong by more than {100.0 * _WRONG:g} %: {len(wrong)}",
        *(f"  seed {one.seed}: by {100.0 * one.readout:.2g} %" for one in wrong),
        *duties(found),
        *table(found),
    ]


def duties(found: list[Trial]) -> list[str]:
    """Report the errors of the duties of pulses, and how many that were given are wrong."""
    sure = [one for one in found if one.is_sure_of("exposure") and np.isfinite(one.duty)]
    measured = [one for one in sure if np.isfinite(one.duty_deviation)]
    off = np.abs([one.duty / one.duty_deviation for one in measured])
    told_wrong = sum(abs(one.duty) > _WRONG for one in sure if one not in measured)
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
        error = np.abs([getattr(one, what) for one in sure])
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
