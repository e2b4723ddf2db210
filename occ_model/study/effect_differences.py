"""Measure what leaving an effect out of the complete simulation changes, and what it looks like."""

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, Pixels
from occ_model.effects.paper_view import paper_view_of
from occ_model.effects.plan import plan
from occ_model.results.effect_costs import EffectDifference
from occ_model.results.plan import Plan
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable
from occ_model.simulation.render import observe, render_plan
from occ_model.simulation.stage_timer import StageTimer
from occ_model.study.telling_crop import ICON, telling_crop

_SAMPLES = 2**16  # maximum number of samples kept of a change
_VISIBLE_CHANGE = 0.05  # RMS in grey levels below which a change of the panel's pixels is not seen
_SIZE_PER_MARGIN = 16  # the panel's size in margins


class CompleteSimulation:
    """The simulation of a scene with all its effects, and what has been compared with it."""

    def __init__(
        self, scene: Scene, observable: Observable, seed: int = 1, timer: StageTimer | None = None
    ) -> None:
        self._scene, self._observable, self._seed = scene, observable, seed
        complete = plan(scene, 0.0, observable)
        self._stretch = complete.stretch
        self.effects = complete.included
        """The names of all effects of the scene."""
        self._seen = self._simulated(self.effects, observable, timer)
        self._bare = self._simulated((), "image", timer)
        size = self._seen.size
        self._places = np.arange(size) if size <= _SAMPLES else _some(size)
        self._differences: dict[str, EffectDifference] = {}
        self._errors = {frozenset(self.effects): 0.0}

    @property
    def errors(self) -> Mapping[frozenset[str], float]:
        """The errors measured until now, by the effects of the scene that are included."""
        return dict(self._errors)

    def without(self, effect: str, timer: StageTimer | None = None) -> EffectDifference:
        """Measure what leaving out one of the effects changes."""
        if effect not in self._differences:
            self._differences[effect] = self._difference(effect, timer)
        return self._differences[effect]

    def error_of(self, effects: Iterable[str], timer: StageTimer | None = None) -> float:
        """Measure the error of a simulation with these effects, in levels."""
        included = frozenset(self.effects) & frozenset(effects)
        if included not in self._errors:
            seen = self._simulated(included, self._observable, timer)
            self._errors[included] = rms(self._seen - seen) * self._stretch
        return self._errors[included]

    def _difference(self, effect: str, timer: StageTimer | None) -> EffectDifference:
        others = frozenset(self.effects) - {effect}
        difference = (self._seen - self._simulated(others, self._observable, timer)).ravel()
        error = rms(difference) * self._stretch
        self._errors[others] = error
        change = difference[self._places].astype(np.float64) * self._stretch
        # Of a change that few pixels show, a sample may have more or less than its share.
        change *= error / max(rms(change), np.finfo(float).tiny)
        alone, bare = self._alone(effect, timer)
        crop, icon = telling_crop(alone, bare), telling_crop(alone, bare, ICON)
        return EffectDifference(effect, error, change, crop, icon)

    def _alone(self, effect: str, timer: StageTimer | None) -> tuple[Pixels, Pixels]:
        """Return the paper's model with one effect, and without it: noise and file hide many."""
        alone = self._simulated((effect,), "image", timer)
        if rms(alone - self._bare) >= _VISIBLE_CHANGE:
            return alone, self._bare
        # It may move the panel's outline outwards.
        return self._with_margin((effect,), timer), self._with_margin((), timer)

    def _with_margin(self, effects: Iterable[str], timer: StageTimer | None) -> Pixels:
        """Return the camera's pixels of the panel and a little of its surroundings."""
        view = paper_view_of(self._scene)
        chosen = plan_of_effects(self._scene, "image", effects)
        frame = render_plan(view, chosen, seed=self._seed, timer=timer)
        rows, columns = (
            slice(max(0, first - length // _SIZE_PER_MARGIN), last + length // _SIZE_PER_MARGIN)
            for first, last, length in (
                (view.region.first_row, view.region.last_row, view.region.rows),
                (view.region.first_column, view.region.last_column, view.region.columns),
            )
        )
        return frame.camera_image[rows, columns].astype(np.float32)

    def _simulated(
        self, effects: Iterable[str], observable: Observable, timer: StageTimer | None
    ) -> Pixels:
        chosen = plan_of_effects(self._scene, observable, effects)
        return observe(self._scene, chosen, seed=self._seed, timer=timer)


def plan_of_effects(scene: Scene, observable: Observable, effects: Iterable[str]) -> Plan:
    """Return a plan that includes these effects and no other."""
    return plan(scene, np.inf, observable, dict.fromkeys(sorted(effects), True))


def rms(values: Pixels | FloatArray) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(values.ravel(), dtype=np.float64))))


def _some(size: int) -> NDArray[np.int64]:
    return np.random.default_rng(0).integers(0, size, _SAMPLES)
