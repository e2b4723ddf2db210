"""How close estimates are, and how the promise holds: ``python tests/benchmarks/estimates.py``.

``presets`` prints, for each effect and observable of the presets with a lens, what the plan
estimates, what leaving the effect out of the complete simulation changes, and their ratio.
``scenes [number] [first]`` does so for random scenes of a world wider than the sliders, keeps it,
and tries the promise on them: the planned simulation against the complete one at some tolerances.
``figure [file]`` draws the ratios that were kept. ``plans [folder]`` prints how many effects are
taken in, and the milliseconds of a picture, at some tolerances; ``planning [folder]`` prints the
milliseconds of a plan. With the folder of another state of the program both are tried in turn.
"""

import json
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from tqdm import tqdm

sys.path.insert(0, str(Path(__file__).parents[1]))

from physics.effect_world import present, rms, scene_of, seen

import occ_model as occ
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable

BEFORE_DECISION: tuple[Observable, ...] = ("image", "profile", "signal")
TOLERANCES = (0.5, 2.0, 8.0)
_WITH_LENS = [name for name in occ.presets() if name.endswith("-real")]
KEPT = Path(".estimates.jsonl")
SMALL = 0.1
"""Levels below which neither an estimate nor a change matters to any plan."""


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
) -> Iterator[tuple[str, str, float, float]]:
    """Give observable, effect, estimate and change; for a plan its tolerance as the effect."""
    for observable in BEFORE_DECISION:
        everything = occ.plan(scene, 0.0, observable)
        effects, stretch = present(everything), everything.stretch
        complete = seen(scene, effects, observable, seed)
        change = _ChangeOf(scene, complete, observable, seed, stretch)
        for decision in everything.decisions:
            if decision.included:
                name = decision.effect
                yield observable, name, decision.estimate, change(effects - {name})
        for tolerance in tolerances:
            chosen = present(occ.plan(scene, tolerance, observable))
            yield observable, f"tolerance {tolerance:g}", tolerance, change(chosen)


def presets() -> None:
    print(
        "| preset | observable | effect | estimate | measured | ratio |\n|---|---|---|---|---|---|"
    )
    for name in _WITH_LENS:
        for row in compared(occ.load_preset(name), 1):
            observable, effect, estimate, change = row
            ratio = estimate / max(change, 1e-9)
            sizes = f"{estimate:.3g} | {change:.3g} | {ratio:.2f}"
            print(f"| {name} | {observable} | {effect} | {sizes} |")


def scenes(count: int, first: int) -> None:
    with KEPT.open("a", encoding="utf-8") as file:
        for seed in tqdm(range(first, first + count), "scenes"):
            for row in compared(scene_of(seed), seed, TOLERANCES):
                file.write(json.dumps([seed, *row]) + "\n")
    summary()


def kept() -> list[tuple[int, str, str, float, float]]:
    return [tuple(json.loads(line)) for line in KEPT.read_text(encoding="utf-8").splitlines()]


def summary() -> None:
    ratios: dict[tuple[str, str], list[float]] = defaultdict(list)
    shares: dict[tuple[str, str], list[tuple[float, int]]] = defaultdict(list)
    for seed, observable, effect, estimate, change in kept():
        if effect.startswith("tolerance"):
            shares[observable, effect].append((change / estimate, seed))
        elif max(estimate, change) > SMALL:
            ratios[observable, effect].append(estimate / max(change, 1e-9))
    print("| observable | effect | scenes | 1 % | 5 % | median | 95 % | below 1 | above 1.5 |")
    print("|---|---|---|---|---|---|---|---|---|")
    everything = []
    for (observable, effect), values in sorted(ratios.items()):
        everything += values
        print(_line(observable, effect, values))
    print(_line("all", "all", everything))
    held = [share <= 1.0 for values in shares.values() for share, _ in values]
    print(f"\nThe promise holds in {100.0 * np.mean(held):.2f} % of {len(held)} plans.")
    for (observable, effect), found in sorted(shares.items()):
        worst = sorted(found, reverse=True)[:6]
        text = ", ".join(f"{share:.2f} (scene {seed})" for share, seed in worst)
        over = sum(share > 1.0 for share, _ in found)
        print(f"{observable}, {effect}: {over} of {len(found)} above it; largest {text}")


def _line(observable: str, effect: str, values: list[float]) -> str:
    one, five, middle, most = np.quantile(values, (0.01, 0.05, 0.5, 0.95))
    array = np.array(values)
    below, above = 100.0 * np.mean(array < 1.0), 100.0 * np.mean(array > 1.5)
    return (
        f"| {observable} | {effect} | {len(values)} | {one:.2f} | {five:.2f} | {middle:.2f} | "
        f"{most:.3g} | {below:.0f} % | {above:.0f} % |"
    )


def plans(folder: str = "") -> None:
    """Print effects and shortest milliseconds of each state of the program, side by side."""
    tolerances = (0.0, 1.0, 2.0, 5.0, 10.0)
    print("| preset |" + "".join(f" {tolerance:g} |" for tolerance in tolerances))
    print("|---" * (1 + len(tolerances)) + "|")
    for name in _WITH_LENS:
        tried = _in_turn(_RENDERED.format(name=name, tolerances=tolerances), folder, 3)
        cells = [
            " → ".join(f"{int(state[at][0])} effects, {state[at][1]:.0f} ms" for state in tried)
            for at in range(len(tolerances))
        ]
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


def planning(folder: str = "") -> None:
    """Print the shortest milliseconds of a plan of each state of the program, side by side."""
    print("| scene | " + " | ".join(BEFORE_DECISION) + " |\n|---" + "|---" * 3 + "|")
    for name in ("phone-136us", "phone-136us-real"):
        code = _PLANNED.format(name=name, observables=BEFORE_DECISION)
        tried = _in_turn(code, folder, 5)
        cells = [" → ".join(f"{state[at][1]:.2f}" for state in tried) for at in range(3)]
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


_PLANNED = """
import time, occ_model as occ
scene = occ.load_preset({name!r})
for observable in {observables!r}:
    times = []
    for place in range(40):
        other = scene.replace(start_time=1e-7 * place)
        start = time.process_time()
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


def figure(file: str = "estimates.png") -> None:
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    ratios = defaultdict(list)
    for _, observable, effect, estimate, change in kept():
        if not effect.startswith("tolerance") and max(estimate, change) > SMALL:
            ratios[observable].append(estimate / max(change, 1e-3))
    drawn, axes = pyplot.subplots(1, 3, figsize=(9, 2.6), sharey=True, layout="constrained")
    edges = np.geomspace(0.1, 10.0, 61)
    for axis, observable in zip(axes, BEFORE_DECISION, strict=True):
        shown = np.clip(ratios[observable], edges[0], edges[-1])
        axis.hist(shown, edges, weights=np.full(len(shown), 100.0 / len(shown)), color="#4477aa")
        axis.axvspan(1.0, 1.5, color="#ccbb44", alpha=0.3, lw=0)
        axis.set(xscale="log", title=observable, xlabel="estimate / measured")
    axes[0].set_ylabel("share of effects (%)")
    drawn.savefig(file, dpi=110)


if __name__ == "__main__":
    what, *rest = sys.argv[1:] or ["presets"]
    if what == "scenes":
        scenes(int(rest[0]) if rest else 200, int(rest[1]) if rest[1:] else 0)
    else:
        commands = {
            "presets": presets, "summary": summary, "plans": plans, "planning": planning,
            "figure": figure,
        }  # fmt: skip
        commands[what](*rest)
