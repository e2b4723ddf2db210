"""Measure the time and the error of each simulation method for a scene.

There are four comparisons: samples of the exposure with its closed form, effects added one by one
with all of them, the profile path with the image path, and drafts with the whole picture. All
errors are RMS in the unit of the plan: levels of the stretched profile, or margins of a decision.
"""

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import accumulate, cycle
from operator import mul
from statistics import median
from time import perf_counter
from typing import TypeVar

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.exposure import lit_fraction
from occ_model.camera.photometry import ColumnLight, panel_values, saturate
from occ_model.camera.projection import check_size
from occ_model.effects.effect import paper_view_of
from occ_model.effects.plan import plan
from occ_model.light.cosine import Cosine
from occ_model.light.sent import Light, light_of
from occ_model.results.accuracy import CLOSED_FORM, AccuracyPoint
from occ_model.results.frame import Frame, Plan
from occ_model.scene.argument_checks import check_seed
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.columns import expose_columns
from occ_model.simulation.render import observe, render
from occ_model.study.effect_differences import CompleteSimulation, plan_of_effects, rms
from occ_model.study.observation import panel_span

SAMPLES = tuple(2**power for power in range(13))  # numbers of samples of an exposure
DRAFT_STEPS = (4, 16, 64)  # row steps of the drafts
_MIN_DRAFT_ROWS = 4  # minimum number of the panel's rows in a draft
_EXACT_COLUMNS = 97  # number of columns whose reference is computed in rational arithmetic
Result = TypeVar("Result")

_ENOUGH_SECONDS = 0.15  # time of the moves after which no further one is timed
_MOVES = 5  # most moves that are timed
_MOVE = 1.003  # factor by which a move changes the exposure time
_PLACES = cycle(range(4, 44))
"""Numbers of moves from the scene to the next place that is timed. The window times the first three
itself, and no cache remembers as many places as these."""


def accuracy(
    scene: Scene,
    settings: SimulationSettings | None = None,
    complete: CompleteSimulation | None = None,
) -> Iterator[AccuracyPoint]:
    """Measure the time and the error of each simulation method, point by point.

    Parameters
    ----------
    settings
        The current settings, by default ``SimulationSettings()``.
    complete
        The complete simulation with the observable and the seed of the settings, if available.

    Raises
    ------
    ParameterError
        A setting is not allowed.
    ProjectionError
        The scene has no picture.
    """
    settings = settings or SimulationSettings()
    check_seed(settings.seed)
    check_size(scene.camera)
    chosen = plan(scene, settings.tolerance, settings.observable, settings.force)
    points = _measure_points(scene, settings, chosen, complete)
    return (replace(point, unit=chosen.unit) for point in points)


def point_count(scene: Scene, settings: SimulationSettings | None = None) -> int:
    settings = settings or SimulationSettings()
    complete = plan(scene, 0.0, settings.observable)
    paths = 1 if panel_span(scene) is None else 2
    drafts = len(draft_steps(scene))
    return len(SAMPLES) + 1 + len(complete.included) + 2 + paths + drafts


def _measure_points(
    scene: Scene,
    settings: SimulationSettings,
    chosen: Plan,
    complete: CompleteSimulation | None,
) -> Iterator[AccuracyPoint]:
    yield from _measure_integration(scene, chosen.stretch)
    complete = complete or CompleteSimulation(scene, settings.observable, settings.seed)
    yield from _measure_added_effects(scene, settings, chosen, complete)
    yield from _measure_paths(scene, settings, chosen)
    yield from _measure_drafts(scene, settings, chosen)


def _measure_integration(scene: Scene, stretch: float) -> Iterator[AccuracyPoint]:
    """Compare sampled and closed-form exposures with exact rational arithmetic."""
    columns = scene.camera.columns
    sample_columns = np.unique(np.linspace(0, columns - 1, _EXACT_COLUMNS).astype(np.int64))
    truth = _profile(scene, exact_lit_fraction(scene, sample_columns))

    def error(lit: FloatArray) -> float:
        return rms(_profile(scene, lit[sample_columns]) - truth) * stretch

    for samples in SAMPLES:
        seconds, lit = time_moves(partial(sampled_lit_fraction, samples=samples), scene)
        name = f"{samples} sample{'s' if samples > 1 else ''}"
        yield AccuracyPoint("integration", name, seconds, error(lit))
    seconds, lit = time_moves(lit_fraction, scene)
    yield AccuracyPoint("integration", CLOSED_FORM, seconds, error(lit))


def _profile(scene: Scene, lit: FloatArray) -> FloatArray:
    return saturate(panel_values(scene, ColumnLight(lit, np.ones(1))))


def _measure_added_effects(
    scene: Scene, settings: SimulationSettings, chosen: Plan, complete: CompleteSimulation
) -> Iterator[AccuracyPoint]:
    """Add the effects one by one, in falling order of their estimates."""
    by_estimate = sorted(chosen.decisions, key=lambda decision: -decision.estimate)
    added = [decision for decision in by_estimate if decision.effect in complete.effects]
    effects = [decision.effect for decision in added]
    for count, name in enumerate(["paper's model", *(f"+ {each.label}" for each in added)]):
        yield _measure_effects(scene, name, effects[:count], settings, complete)
    yield _measure_effects(scene, "this plan", chosen.included, settings, complete, current=True)


def _measure_effects(
    scene: Scene,
    name: str,
    effects: Sequence[str],
    settings: SimulationSettings,
    complete: CompleteSimulation,
    *,
    current: bool = False,
) -> AccuracyPoint:
    error = complete.error_of(effects)
    seconds, _ = time_moves(_rendering(effects, settings), scene)
    return AccuracyPoint("effects", name, seconds, error, current, tuple(effects))


def _rendering(
    effects: Sequence[str], settings: SimulationSettings, rows_step: int = 1
) -> Callable[[Scene], Frame]:
    """Return a function that renders a scene with exactly these effects."""
    force = dict.fromkeys(sorted(effects), True)
    return partial(render, tolerance=np.inf, seed=settings.seed, force=force, rows_step=rows_step)


def _panel_columns(scene: Scene) -> slice:
    region = paper_view_of(scene).region
    return slice(region.first_column, region.last_column)


def _measure_paths(
    scene: Scene, settings: SimulationSettings, chosen: Plan
) -> Iterator[AccuracyPoint]:
    """Compare the profile path and the image path with the profile that has all effects."""
    seed, seen = settings.seed, _panel_columns(scene)
    truth = observe(scene, plan(scene, 0.0, "profile"), seed=seed)
    seconds, columns = time_moves(lambda moved: expose_columns(paper_view_of(moved), chosen), scene)
    error = rms(columns.profile[seen] - truth) * chosen.stretch
    if panel_span(scene) is not None:
        yield AccuracyPoint("path", "profile path", seconds, error)
    by_image = plan_of_effects(scene, "profile", chosen.included)
    difference = observe(scene, by_image, seed=seed) - truth
    seconds, _ = time_moves(_rendering(chosen.included, settings), scene)
    yield AccuracyPoint("path", "image path", seconds, rms(difference) * chosen.stretch)


def _measure_drafts(
    scene: Scene, settings: SimulationSettings, chosen: Plan
) -> Iterator[AccuracyPoint]:
    """Compare the profiles of drafts with that of the complete picture."""
    steps = draft_steps(scene)
    if not steps:
        return
    seen = _panel_columns(scene)
    truth = render(scene, tolerance=0.0, seed=settings.seed).profile[seen]
    for step in steps:
        seconds, frame = time_moves(_rendering(chosen.included, settings, step), scene)
        error = rms(frame.profile[seen] - truth) * chosen.stretch
        yield AccuracyPoint("draft", f"draft 1/{step}", seconds, error)


def draft_steps(scene: Scene) -> tuple[int, ...]:
    """Return the row steps that leave enough rows of the panel."""
    rows = paper_view_of(scene).region.rows
    return tuple(step for step in DRAFT_STEPS if step * _MIN_DRAFT_ROWS <= rows)


def time_moves(work: Callable[[Scene], Result], scene: Scene) -> tuple[float, Result]:
    """Return the median time after moves of the exposure's slider, and the scene's own result.

    Slow work is timed for fewer moves. The scene itself would be faster than a move, because parts
    of it are remembered, or slower, because others are prepared for the first time.
    """
    result, times = work(scene), list[float]()
    while len(times) < _MOVES and sum(times) < _ENOUGH_SECONDS:
        moved = move(scene, "exposure_time", next(_PLACES))
        start = perf_counter()
        work(moved)
        times.append(perf_counter() - start)
    return median(times), result


def move(scene: Scene, name: str, place: int) -> Scene:
    """Return a scene after some small moves of a slider; raises OccError at its end."""
    value, highest, factor = float(scene.value(name)), quantity(name).slider[1], _MOVE**place
    return scene.replace(**{name: value * factor if value * factor <= highest else value / factor})


_SAMPLES_AT_ONCE = 1_000_000


def sampled_lit_fraction(scene: Scene, samples: int) -> FloatArray:
    """Return the mean light of every column, from samples in the middle of equal time steps."""
    light, camera = light_of(scene.transmitter), scene.camera
    within = (np.arange(samples) + 0.5) * (camera.exposure_time / samples)
    lit = np.empty(camera.columns)
    step = max(1, _SAMPLES_AT_ONCE // samples)
    for first in range(0, camera.columns, step):
        column = np.arange(first, min(first + step, camera.columns))
        start = scene.model.start_time + column * camera.readout_time
        lit[column] = _light_at(light, start[:, None] + within).mean(axis=1)
    return lit


def _light_at(light: Light, seconds: FloatArray) -> FloatArray:
    if isinstance(light, Cosine):
        phase = 2.0 * np.pi * light.frequency * seconds + light.phase
        return np.asarray(1.0 + light.depth * np.cos(phase))
    waveform = light.waveform
    units = seconds * float(light.rate)
    if waveform.has_equal_pieces:
        piece = np.floor(units).astype(np.int64) % waveform.period
    else:
        edges = np.cumsum(waveform.lengths).astype(np.float64)
        piece = np.searchsorted(edges[:-1], units % waveform.period, side="right")
    return waveform.levels.astype(np.float64)[piece]


def exact_lit_fraction(scene: Scene, columns: IndexArray) -> FloatArray:
    """Return the mean light of some columns from exact times, rounded once at the end.

    A cosine, which is no fraction, is computed from an exact phase.
    """
    light_source = light_of(scene.transmitter)
    exposure = Fraction(scene.camera.exposure_time)
    first, step = Fraction(scene.model.start_time), Fraction(scene.camera.readout_time)
    starts = [first + column * step for column in columns.tolist()]
    if isinstance(light_source, Cosine):
        return np.array(
            [float(light_source.means(start, step, 1, exposure)[0]) for start in starts]
        )
    waveform = light_source.waveform
    levels, lengths = (
        [Fraction(each) for each in exact.tolist()] for exact in (waveform.levels, waveform.lengths)
    )
    edges = list(accumulate(lengths, initial=Fraction(0)))
    cumulative_light = list(accumulate(map(mul, levels, lengths), initial=Fraction(0)))

    def light_until(seconds: Fraction) -> Fraction:
        periods, elapsed = divmod(seconds * light_source.rate, waveform.period)
        piece = bisect_right(edges, elapsed) - 1
        light: Fraction = periods * cumulative_light[-1] + cumulative_light[piece]
        light += (elapsed - edges[piece]) * levels[piece]
        return light

    units = exposure * light_source.rate
    return np.array(
        [float((light_until(start + exposure) - light_until(start)) / units) for start in starts]
    )
