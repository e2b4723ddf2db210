"""How close estimates are, and how the promise holds: ``python tests/benchmarks/estimates.py``.

``presets`` prints, for each effect and observable of the presets with a lens, what the plan
estimates, what leaving the effect out of the complete simulation changes, and their ratio.
``scenes [number] [first]`` does so for random scenes of a world wider than the sliders, keeps it,
and tries the promise on them: the planned simulation against the complete one at some tolerances;
``large [number] [first]`` for pictures of so many columns that a plan samples some of them.
``figure [file]`` draws the ratios that were kept. ``plans [folder]`` prints how many effects are
taken in at some tolerances, and how long a picture takes; ``planning [folder]`` prints how long a
plan takes. With the folder of another state of the program both are tried in turn.
``decision [images]`` prints what a threshold decoder reads of a preset with the effects that the
signal calls for and without those that make rows differ, the processor time of an image, and how
many images the search of a limit takes near its ends.
"""

import json
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from time import process_time
from typing import Any
from unittest import mock

import numpy as np
from tqdm import tqdm

sys.path.insert(0, str(Path(__file__).parents[1]))

from physics.effect_world import large_scene_of, present, rms, scene_of, seen

import occ_model as occ
from occ_model.effects.registry import EFFECTS
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable
from occ_model.study import sure_ends, working_range
from occ_model.study.success_rate import right_and_whole

BEFORE_DECISION: tuple[Observable, ...] = ("image", "profile", "signal")
TOLERANCES = (0.5, 2.0, 8.0)
_WITH_LENS = [name for name in occ.presets() if name.endswith("-real")]
KEPT = Path(".estimates.jsonl")
SMALL = 0.1
"""Levels below which neither an estimate nor a change matters to any plan."""

KNOWN = 2.0
"""Times its estimate that the limit of an effect is at most where a plan knows what it changes."""


class _ChangeOf:
    """What leaving all but some effects out changes, each set measured once."""

    def __init__(
        self, scene: Scene, complete: np.ndarray, observable: Observable, seed: int, stretch: float
    ) -> None:
        self._seen = scene, observable, seed
        self._complete, self._stretch = complete, stretch
        self._known: dict[frozenset[str], float] = {}

    def __call__(self, included: frozenset[str]) -> float:
        if included not in self._known:
            scene, observable, seed = self._seen
            found = seen(scene, included, observable, seed)
            self._known[included] = rms(self._complete - found) * self._stretch
        return self._known[included]


def compared(
    scene: Scene, seed: int, tolerances: tuple[float, ...] = ()
) -> Iterator[tuple[str, str, float, float, float]]:
    """Give observable, effect, estimate, limit and change; a plan's tolerance is both of these."""
    for observable in BEFORE_DECISION:
        everything = occ.plan(scene, 0.0, observable)
        effects, stretch = present(everything), everything.stretch
        complete = seen(scene, effects, observable, seed)
        change = _ChangeOf(scene, complete, observable, seed, stretch)
        for decision in everything.decisions:
            if decision.included:
                name = decision.effect
                sizes = decision.estimate, decision.limit
                yield observable, name, *sizes, change(effects - {name})
        for tolerance in tolerances:
            chosen = present(occ.plan(scene, tolerance, observable))
            yield observable, f"tolerance {tolerance:g}", tolerance, tolerance, change(chosen)


def presets() -> None:
    """Print estimate, change and their ratio of each effect of the presets with a lens."""
    print("| preset | effect |" + "".join(f" {one} | | |" for one in BEFORE_DECISION))
    print("|---" * (2 + 3 * len(BEFORE_DECISION)) + "|")
    ratios, below = [], 0
    for name in _WITH_LENS:
        cells: dict[str, list[str]] = defaultdict(list)
        for _, effect, estimate, limit, change in compared(occ.load_preset(name), 1):
            ratio = estimate / max(change, 1e-9)
            cells[effect] += [f"{estimate:.2g}", f"{change:.2g}", f"{ratio:.2f}"]
            ratios += [ratio] if change > SMALL else []
            below += change > limit
        for effect, row in cells.items():
            print(f"| {name} | {effect} | {' | '.join(row)} |", flush=True)
    ends = " to ".join(f"{end:.2f}" for end in (min(ratios), max(ratios)))
    close = f"{ends} times, in the median {np.median(ratios):.2f} times"
    print(f"\nOf {len(ratios)} changes above {SMALL:g} levels the estimates are {close}.")
    print(f"{below} changes are above their limits.")


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


def plans(folder: str = "") -> None:
    """Print how many effects are taken in, and the time of a picture over that of all effects'."""
    tolerances = (0.0, 1.0, 2.0, 5.0, 10.0)
    print("| preset |" + "".join(f" {tolerance:g} |" for tolerance in tolerances))
    print("|---" * (1 + len(tolerances)) + "|")
    for name in _WITH_LENS:
        tried = _in_turn(_RENDERED.format(name=name, tolerances=tolerances), folder, 2)
        cells = [
            " → ".join(f"{int(state[at][0])}, {state[at][1] / state[0][1]:.2f}" for state in tried)
            for at in range(len(tolerances))
        ]
        whole = " → ".join(f"{state[0][1]:.0f}" for state in tried)
        print(f"| {name} ({whole} ms) | {' | '.join(cells)} |", flush=True)


def planning(folder: str = "") -> None:
    """Print the shortest milliseconds of plans of each state of the program, side by side.

    A slider's movement plans the picture, and then the signal of the same scene.
    """
    asked = [*((one,) for one in BEFORE_DECISION), ("image", "signal")]
    print("| preset |" + "".join(f" {' and '.join(one)} |" for one in asked))
    print("|---" * (1 + len(asked)) + "|")
    for name in ("phone-136us", "phone-136us-real", "tablet-122us-real"):
        tried = _in_turn(_PLANNED.format(name=name, asked=asked), folder, 4)
        cells = []
        for at in range(len(asked)):
            times = [state[at][1] for state in tried]
            ratio = f" ({times[0] / times[-1]:.1f})" if folder else ""
            cells.append(" → ".join(f"{one:.1f}" for one in times) + ratio)
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


_PLANNED = """
import time, occ_model as occ
scene = occ.load_preset({name!r})
for observables in {asked!r}:
    times = []
    for place in range(30):
        other = scene.replace(start_time=1e-7 * place + 1e-5 * len(observables))
        start = time.process_time()
        for observable in observables:
            occ.plan(other, 0.5, observable)
        times.append(time.process_time() - start)
    print(0, 1e3 * min(times))
"""

_RENDERED = """
import time, occ_model as occ
scene = occ.load_preset({name!r})
for tolerance in {tolerances!r}:
    times = []
    for _ in range(3):
        start = time.process_time()
        frame = occ.render(scene, tolerance=tolerance, noise="reused")
        times.append(time.process_time() - start)
    print(len(frame.plan.included), 1e3 * min(times))
"""


def _in_turn(code: str, folder: str, rounds: int) -> list[list[tuple[float, float]]]:
    """Run code in each state of the program in turn; give its numbers with the least times."""
    own = str(Path(__file__).parents[2])
    found: list[list[tuple[float, float]]] = [[] for _ in range(2 if folder else 1)]
    for _ in range(rounds):
        for at, state in enumerate([folder, own] if folder else [own]):
            command = [sys.executable, "-c", code]
            text = subprocess.run(command, cwd=state, check=True, capture_output=True).stdout
            lines = [tuple(map(float, line.split())) for line in text.splitlines()]
            pairs = zip(found[at] or lines, lines, strict=True)
            found[at] = [(count, min(seconds, last)) for (_, last), (count, seconds) in pairs]
    return found


def decision(images: str = "20") -> None:
    """Try whether leaving effects out changes what a threshold decoder reads."""
    scene = occ.load_preset("phone-136us-real")
    alike = {e.name: False for e in EFFECTS if e.kind == "image"}
    print("| frequency | images read: all effects | rows alike | ms: all effects | rows alike |")
    print("|---" * 5 + "|")
    for frequency in (3.39e3, 3.6e3, 10e3, 13.5e3, 13.9e3, 14.1e3, 14.3e3):
        read, times = [], []
        for force in ({}, alike):
            settings = RateSettings(int(images), ("threshold",), 77, force=force)
            start = process_time()
            _, (whole,) = right_and_whole(scene.replace(switching_frequency=frequency), settings)
            times.append(f"{1e3 * (process_time() - start) / settings.images:.0f}")
            read.append(f"{whole} of {images}")
        print(f"| {frequency / 1e3:g} kHz | {' | '.join(read + times)} |", flush=True)
    counted = _images_of_search(scene, RateSettings(20, ("threshold",), 5, force=alike))
    total, ends = sum(counted.values()), ((0.0, 3.3e3), (3.3e3, 3.7e3), (3.7e3, 13e3), (13e3, 15e3))
    for low, high in (*ends, (15e3, 1e9)):
        there = sum(number for value, number in counted.items() if low <= value < high)
        print(f"{there} of {total} images from {low:g} to {high:g} Hz")


def _images_of_search(scene: Scene, settings: RateSettings) -> Counter[float]:
    counted: Counter[float] = Counter()
    original = working_range.right_bits_at

    def counting(scene: Scene, name: str, value: float, *rest: Any) -> Iterator[int]:
        for bits in original(scene, name, value, *rest):
            counted[value] += 1
            yield bits

    with (
        mock.patch.object(working_range, "right_bits_at", counting),
        mock.patch.object(sure_ends, "right_bits_at", counting),
    ):
        found = working_range.working_range(scene, "switching_frequency", 99.0, settings)
        for pair in sure_ends.pairs_of(found):
            sure_ends.sure_end(scene, found.parameter, 99.0, settings, pair, lambda: None)
    return counted


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
        commands = {
            "presets": presets, "summary": summary, "plans": plans, "planning": planning,
            "figure": figure, "decision": decision,
        }  # fmt: skip
        commands[what](*rest)
