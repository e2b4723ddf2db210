"""Measure how omitting effects changes the complete simulation, and forecast what it saves."""

from collections.abc import Iterable, Mapping
from functools import lru_cache

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.photometry import WHITE
from occ_model.effects.effect import paper_view_of
from occ_model.effects.plan import effect_sets_of, plan, plan_with
from occ_model.effects.registry import EFFECTS
from occ_model.results.accuracy import EffectCrop, EffectDifference, Forecast, MeasuredCosts
from occ_model.results.frame import EffectSet, Plan
from occ_model.scene.scene import Observable, Scene, SimulationSettings
from occ_model.simulation.render import observe, render_plan
from occ_model.simulation.stage_timer import StageTimer

_SAMPLES = 2**16  # maximum number of samples of a change that are kept
_VISIBLE_CHANGE = 0.05  # RMS in grey levels below which a change of the panel's pixels is invisible
_SIZE_PER_MARGIN = 16  # size of the panel divided by that of a margin


class CompleteSimulation:
    """The simulation of a scene with all its effects, and the comparisons with it."""

    def __init__(
        self, scene: Scene, observable: Observable, seed: int = 1, timer: StageTimer | None = None
    ) -> None:
        self._scene, self._observable, self._seed = scene, observable, seed
        complete = plan(scene, 0.0, observable)
        self._stretch = complete.stretch
        self.effects = complete.included  # the names of all effects of the scene
        self._complete = self._simulate(self.effects, observable, timer)
        self._without_effects = self._simulate((), "image", timer)
        size = self._complete.size
        random = np.random.default_rng(0)
        self._places = np.arange(size) if size <= _SAMPLES else random.integers(0, size, _SAMPLES)
        self._differences: dict[str, EffectDifference] = {}
        self._errors = {frozenset(self.effects): 0.0}

    @property
    def errors(self) -> Mapping[frozenset[str], float]:
        """The errors measured so far, by the scene's effects that are included."""
        return dict(self._errors)

    def without(self, effect: str, timer: StageTimer | None = None) -> EffectDifference:
        """Measure what omitting one of the effects changes."""
        if effect not in self._differences:
            self._differences[effect] = self._measure_difference(effect, timer)
        return self._differences[effect]

    def error_of(self, effects: Iterable[str], timer: StageTimer | None = None) -> float:
        """Measure the error of a simulation with only these effects, in levels."""
        included = frozenset(self.effects) & frozenset(effects)
        if included not in self._errors:
            observation = self._simulate(included, self._observable, timer)
            self._errors[included] = rms(self._complete - observation) * self._stretch
        return self._errors[included]

    def _measure_difference(self, effect: str, timer: StageTimer | None) -> EffectDifference:
        others = frozenset(self.effects) - {effect}
        difference = (self._complete - self._simulate(others, self._observable, timer)).ravel()
        error = rms(difference) * self._stretch
        self._errors[others] = error
        change = difference[self._places].astype(np.float64) * self._stretch
        # Restore the RMS, because few pixels may change and the sample may miss or overrepresent
        # them.
        change *= error / max(rms(change), np.finfo(float).tiny)
        pictures = self._render_alone(effect, timer)
        crop, icon = choose_crop(*pictures), choose_crop(*pictures, ICON)
        return EffectDifference(effect, error, change, crop, icon)

    def _render_alone(self, effect: str, timer: StageTimer | None) -> tuple[Pixels, Pixels]:
        """Render an effect alone and no effect, because noise and JPEG would hide many effects."""
        alone = self._simulate((effect,), "image", timer)
        if rms(alone - self._without_effects) >= _VISIBLE_CHANGE:
            return alone, self._without_effects
        # The effect may move the panel's outline outwards.
        return self._render_with_margin((effect,), timer), self._render_with_margin((), timer)

    def _render_with_margin(self, effects: Iterable[str], timer: StageTimer | None) -> Pixels:
        """Return the camera's pixels of the panel and of a margin around it."""
        view = paper_view_of(self._scene)
        effect_plan = plan_of_effects(self._scene, "image", effects)
        frame = render_plan(view, effect_plan, seed=self._seed, timer=timer)
        rows, columns = (
            slice(max(0, first - length // _SIZE_PER_MARGIN), last + length // _SIZE_PER_MARGIN)
            for first, last, length in (
                (view.region.first_row, view.region.last_row, view.region.rows),
                (view.region.first_column, view.region.last_column, view.region.columns),
            )
        )
        return frame.camera_image[rows, columns].astype(np.float32)

    def _simulate(
        self, effects: Iterable[str], observable: Observable, timer: StageTimer | None
    ) -> Pixels:
        effect_plan = plan_of_effects(self._scene, observable, effects)
        return observe(self._scene, effect_plan, seed=self._seed, timer=timer)


def plan_of_effects(scene: Scene, observable: Observable, effects: Iterable[str]) -> Plan:
    """Return a plan that includes exactly these effects."""
    return plan(scene, np.inf, observable, dict.fromkeys(sorted(effects), True))


def rms(values: Pixels | FloatArray) -> float:
    return float(np.sqrt(np.mean(np.square(values.ravel(), dtype=np.float64))))


CROP = (64, 112)  # rows and columns of a crop for close inspection
ICON = (16, 40)  # rows and columns of a crop for the line of a table
_MIN_KEPT_FRACTION = 0.7
"""Minimum fraction of a difference that averaging keeps if the averaged panel is shown."""

_CLIPPED_PERCENT = 1.0  # % of pixels at either end that stretching to the full range may clip
_MAX_AMPLIFIED = 256
_MIDDLE_GREY = 128.0


def choose_crop(with_effect: Pixels, without: Pixels, most: tuple[int, int] = CROP) -> EffectCrop:
    """Choose the crop of the panel's bounding rectangle that shows a difference best.

    A coarse difference is shown on the whole panel, reduced by averaging areas. Averaging would
    remove a fine one, which is shown at full resolution where it is largest.
    """
    difference = with_effect - without
    size = (min(most[0], len(difference)), min(most[1], difference.shape[1]))
    small = _average(difference, size)
    is_averaged = rms(small) >= _MIN_KEPT_FRACTION * rms(difference)
    if is_averaged:
        crops = [_average(with_effect, size), _average(without, size), small]
    else:
        place = _largest_window(difference, size)
        crops = [values[place] for values in (with_effect, without, difference)]
    stretched_with, stretched_without = _stretch(crops[0], crops[1])
    factor = _amplification(crops[2])
    amplified = np.clip(_MIDDLE_GREY + factor * crops[2], 0.0, WHITE)
    return EffectCrop(
        stretched_with, stretched_without, amplified.astype(np.uint8), factor, is_averaged
    )


def _average(values: Pixels, size: tuple[int, int]) -> Pixels:
    return np.asarray(cv2.resize(values, size[::-1], interpolation=cv2.INTER_AREA), np.float32)


def _largest_window(difference: Pixels, size: tuple[int, int]) -> tuple[slice, slice]:
    """Return the window in which the difference's mean square is largest."""
    sums = cv2.integral(np.square(difference), sdepth=cv2.CV_64F)
    rows, columns = size
    windows = (sums[rows:, columns:] - sums[:-rows, columns:] - sums[rows:, :-columns]) + sums[
        :-rows, :-columns
    ]
    row, column = np.unravel_index(int(np.argmax(windows)), windows.shape)
    return slice(int(row), int(row) + rows), slice(int(column), int(column) + columns)


def _stretch(one: Pixels, other: Pixels) -> tuple[ByteArray, ByteArray]:
    """Stretch the grey levels of both pictures in the same way."""
    both: FloatArray = np.stack((one, other)).astype(np.float64)
    low, high = np.percentile(both, (_CLIPPED_PERCENT, 100.0 - _CLIPPED_PERCENT))
    grey = np.clip((both - low) * (WHITE / max(high - low, 1.0)), 0.0, WHITE).astype(np.uint8)
    return grey[0], grey[1]


def _amplification(difference: Pixels) -> int:
    """Return the largest power of two that keeps the difference within the grey levels."""
    largest = float(np.percentile(np.abs(difference), 100.0 - _CLIPPED_PERCENT))
    factor = 1
    while factor < _MAX_AMPLIFIED and 2 * factor * largest < _MIDDLE_GREY:
        factor *= 2
    return factor


def forecast(scene: Scene, settings: SimulationSettings, costs: MeasuredCosts) -> Forecast:
    effect_plan = plan_with(scene, settings)
    seconds = _add_seconds(effect_plan.included, costs)
    force = tuple(sorted(settings.force.items()))
    effect_sets = _effect_sets_cached(scene, settings.observable, force)
    forced = frozenset(name for name, on in force if on)
    times = tuple(_add_seconds(tuple(each.effects | forced), costs) for each in effect_sets)
    present = frozenset(decision.effect for decision in effect_plan.decisions if decision.estimate)
    included = present & frozenset(effect_plan.included)
    if included == present or included in costs.errors:
        error = costs.errors.get(included, 0.0)
        return Forecast(effect_plan, seconds, error, True, effect_sets, times)
    omitted = sorted(present - included)
    expected = None
    if all(name in costs.differences for name in omitted):
        expected = rms(np.sum([costs.differences[name].change for name in omitted], axis=0))
    return Forecast(effect_plan, seconds, expected, False, effect_sets, times)


@lru_cache(maxsize=4)
def _effect_sets_cached(
    scene: Scene, observable: Observable, force: tuple[tuple[str, bool], ...]
) -> tuple[EffectSet, ...]:
    """Return the sets of effects from which a plan chooses, cached without the tolerance."""
    return effect_sets_of(scene, SimulationSettings(observable=observable, force=dict(force)))


def _add_seconds(included: tuple[str, ...], costs: MeasuredCosts) -> float | None:
    """Return the measured time, or else the sum of the times of effects and everything else."""
    known = costs.times_with(included)
    if known is not None:
        return known.median
    rows_differ = any(effect.name in included and effect.kind != "column" for effect in EFFECTS)
    measurements = (costs.picture, *costs.others)
    other_times = [each for each in measurements if each.rows_differ == rows_differ]
    if not other_times:
        return None
    total = other_times[0].other_seconds
    added: set[str] = set()
    for name in included:
        seconds = costs.seconds_of(name)
        if seconds is None:
            return None
        groups = (each.shared_steps.get(name) for each in measurements)
        group = next((each for each in groups if each is not None), name)
        if group not in added:
            added.add(group)
            total += seconds
    return total
