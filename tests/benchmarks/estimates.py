"""How close estimates are, and how the promise holds: ``python tests/benchmarks/estimates.py``.

``presets`` prints, for each effect and observable of the presets with a lens, what the plan
estimates, what leaving the effect out of the complete simulation changes, and their ratio.
``scenes [number] [first]`` does so for random scenes of a world wider than the sliders, keeps it,
and tries the promise on them: the planned simulation against the complete one at some tolerances;
``large [number] [first]`` for pictures of so many columns that a plan samples some of them.
``figure [file]`` draws the ratios that were kept.
"""

import json
import sys
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from tqdm import tqdm

sys.path.insert(0, str(Path(__file__).parents[1]))

from physics.effect_world import large_scene_of, measured_changes, scene_of

import occ_model as occ
from occ_model.scene.scene import Observable, Scene

BEFORE_DECISION: tuple[Observable, ...] = ("image", "profile", "signal")
TOLERANCES = (0.5, 2.0, 8.0)
_WITH_LENS = [name for name in occ.presets() if name.endswith("-real")]
KEPT = Path(".estimates.jsonl")
SMALL = 0.1
"""Levels below which neither an estimate nor a change matters to any plan."""

KNOWN = 2.0
"""Times its estimate that the limit of an effect is at most where a plan knows what it changes."""


def compared(
    scene: Scene, seed: int, tolerances: tuple[float, ...] = ()
) -> Iterator[tuple[str, str, float, float, float]]:
    """Yield observable, effect, estimate, limit and change; a plan's tolerance is both of these."""
    for observable in BEFORE_DECISION:
        of_effects, of_plans = measured_changes(scene, observable, seed, tolerances)
        for decision, change in of_effects:
            yield observable, decision.effect, decision.estimate, decision.limit, change
        for tolerance, change in zip(tolerances, of_plans, strict=True):
            yield observable, f"tolerance {tolerance:g}", tolerance, tolerance, change


def presets() -> None:
    """Print estimate, change and their ratio of each effect of the presets with a lens."""
    print("| preset | effect |" + "".join(f" {one} | | |" for one in BEFORE_DECISION))
    print("|---" * (2 + 3 * len(BEFORE_DECISION)) + "|")
    ratios, above = [], []
    for name in _WITH_LENS:
        cells: dict[str, list[str]] = defaultdict(list)
        for observable, effect, estimate, limit, change in compared(occ.load_preset(name), 1):
            ratio = estimate / max(change, 1e-9)
            cells[effect] += [f"{estimate:.2g}", f"{change:.2g}", f"{ratio:.2f}"]
            ratios += [ratio] if change > SMALL else []
            above += [f"{name} {observable} {effect}"] if change > limit else []
        for effect, row in cells.items():
            print(f"| {name} | {effect} | {' | '.join(row)} |", flush=True)
    ends = " to ".join(f"{end:.2f}" for end in (min(ratios), max(ratios)))
    close = f"{ends} times, in the median {np.median(ratios):.2f} times"
    print(f"\nOf {len(ratios)} changes above {SMALL:g} levels the estimates are {close}.")
    print(f"Changes above their limits: {', '.join(above)}")


def scenes(count: int, first: int, world: Callable[[int], Scene] = scene_of) -> None:
    with KEPT.open("a", encoding="utf-8") as file:
        for seed in tqdm(range(first, first + count), "scenes"):
            for row in compared(world(seed), seed, TOLERANCES):
                file.write(json.dumps([seed, *row]) + "\n")
    summary()


def kept() -> list[tuple[int, str, str, float, float, float]]:
    return [tuple(json.loads(line)) for line in KEPT.read_text(encoding="utf-8").splitlines()]


def ratios() -> dict[tuple[str, bool], np.ndarray]:
    """Return estimates over changes, of each observable: where the plan knows them, and of all."""
    found: dict[tuple[str, bool], list[float]] = defaultdict(list)
    for _, observable, effect, estimate, limit, change in kept():
        if not effect.startswith("tolerance") and max(estimate, change) > SMALL:
            for is_known in (True, False) if limit <= KNOWN * estimate else (False,):
                found[observable, is_known].append(estimate / max(change, 1e-3))
    return {key: np.array(values) for key, values in found.items()}


def summary() -> None:
    print("| observable | effects | number | 5 % | median | 95 % | below 0.8 | above 1.5 |")
    print("|---" * 8 + "|")
    for (observable, is_known), values in sorted(ratios().items()):
        quantiles = " | ".join(f"{at:.3g}" for at in np.quantile(values, (0.05, 0.5, 0.95)))
        ends = [100.0 * np.mean(values < 0.8), 100.0 * np.mean(values > 1.5)]
        beyond = " | ".join(f"{fraction:.1f} %" for fraction in ends)
        which = "known" if is_known else "all"
        print(f"| {observable} | {which} | {len(values)} | {quantiles} | {beyond} |")
    fractions = [
        (change / tolerance, seed, observable, effect)
        for seed, observable, effect, tolerance, _, change in kept()
        if effect.startswith("tolerance")
    ]
    held = 100.0 * np.mean([fraction <= 1.0 for fraction, *_ in fractions])
    print(f"\nThe promise holds in {held:.2f} % of {len(fractions)} plans; the largest fractions:")
    for fraction, seed, observable, effect in sorted(fractions, reverse=True)[:6]:
        print(f"{fraction:.2f}: scene {seed}, {observable}, {effect}")


def figure(file: str = "estimates.png") -> None:
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    found = ratios()
    drawn, axes = pyplot.subplots(1, 3, figsize=(9, 2.6), sharey=True, layout="constrained")
    edges = np.geomspace(0.1, 10.0, 61)
    for axis, observable in zip(axes, BEFORE_DECISION, strict=True):
        total = len(found[observable, False])
        for is_known, color, label in ((False, "#bbbbbb", "all"), (True, "#4477aa", "known")):
            shown = np.clip(found[observable, is_known], edges[0], edges[-1])
            weights = np.full(len(shown), 100.0 / total)
            axis.hist(shown, edges, weights=weights, color=color, label=label)
        axis.axvspan(1.0, 1.5, color="#ccbb44", alpha=0.3, lw=0)
        axis.set(xscale="log", title=observable, xlabel="estimate / measured")
    axes[0].set_ylabel("fraction of effects (%)")
    axes[0].legend(frameon=False, loc="upper right")
    drawn.savefig(file, dpi=110)


if __name__ == "__main__":
    what, *rest = sys.argv[1:] or ["presets"]
    if what in ("scenes", "large"):
        world = scene_of if what == "scenes" else large_scene_of
        scenes(int(rest[0]) if rest else 200, int(rest[1]) if rest[1:] else 0, world)
    else:
        commands = {"presets": presets, "summary": summary, "figure": figure}
        commands[what](*rest)
