"""How much an observable of a scene changes without some effects, estimated from a sample."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import FLAT_SPAN, WHITE
from occ_model.effects.effect import Effect, PaperView
from occ_model.effects.observed import SampledObservable
from occ_model.effects.observed_signal import observe_signal, signal_swing
from occ_model.effects.registry import EFFECTS
from occ_model.effects.sampled_pixels import SampledPixels, sample_pixels
from occ_model.effects.simulated_columns import Names
from occ_model.effects.smoothed_curves import add_unsampled, cut_block_square, unsampled_rim_square
from occ_model.errors import ProjectionError
from occ_model.scene.scene import Observable, SimulationSettings
from occ_model.transmitter.scheme import check_code


def observe_image(pixels: SampledPixels) -> SampledObservable:
    """Observe the pixels, whose noise changes with their mean."""
    names, file = pixels.names, pixels.file
    weights = np.sqrt(pixels.sample.pixel_weights).ravel()

    def observe(sets: Sequence[Names]) -> FloatArray:
        return pixels.stored_values(sets).reshape(len(sets), -1) * weights

    noises = tuple(pixels.variances)
    observed = SampledObservable(names, observe, (*pixels.moving, *noises))
    region = pixels.view.region
    count = region.rows * region.columns
    if pixels.sample.outline:
        doubt = unsampled_rim_square(pixels, pixels.table.contrast**2 / count)
        square = 3.0 * pixels.table.contrast**2
        observed.doubt.update(
            {n: doubt + square * pixels.rims.upright_rim_error(n) for n in pixels.sample.outline}
        )
    if file is None:
        for name, moved in pixels.drawn_changes.items():
            observed.independent[name] = moved.mean
            observed.add_doubt([name], moved.doubt(count))
    else:
        observed.independent.update({n: own for n, (own, _) in pixels.noise_read_back.items()})
        observed.independent[pixels.files[0].name] = file.own_change
        squares = np.array([observed.sampled_square(name) for name in pixels.moving])
        doubts = np.array([observed.doubt.get(name, 0.0) for name in pixels.moving])
        rims = (
            np.array([pixels.rims.count_moved_rims(name) for name in pixels.moving])
            * 8.0
            / region.rows
        )
        inside, _, extra = (of_sets[1:] for of_sets in file.growth)
        added = inside + file.growth_at_rims(np.minimum(rims, 1.0), squares + doubts)
        alone = np.maximum(added, -squares)
        doubts += np.maximum(added + extra, -0.5 * (squares + doubts)) - alone
        # What drawing moves, the file spreads over a block.
        relative = [pixels.drawn_changes[name].relative_doubt(count) for name in pixels.moving]
        doubts += np.maximum(alone, 0.0) * relative
        observed.independent.update(zip(pixels.moving, alone.tolist(), strict=True))
        observed.doubt.update(zip(pixels.moving, doubts.tolist(), strict=True))
    add_unsampled(pixels, observed)
    return observed


def observe_profile(pixels: SampledPixels) -> SampledObservable:
    """Observe the means of the columns, after rounding, clipping and the file."""
    names, sample, file = pixels.names, pixels.sample, pixels.file
    rows, weights = pixels.view.region.rows, np.sqrt(sample.weights)

    def observe(sets: Sequence[Names]) -> FloatArray:
        means = pixels.values_read_back(sets)
        if file is not None:  # its error is clipped again where pixels are black or white
            error = math.sqrt(file.own_change / (2.0 * math.pi))
            for included, own in zip(sets, means, strict=True):
                if pixels.files[0].name in included:
                    black, white = pixels.noisy.end_fractions(included, pixels.table.levels)
                    own += pixels.table.interpolate((black - white) * error, own)
        return pixels.mean_of_rows(means) * weights

    observed = SampledObservable(names, observe, sorted(names))
    region = pixels.view.region
    if pixels.sample.outline:
        square = pixels.table.contrast**2
        doubt = unsampled_rim_square(pixels, square / (region.rows**2 * region.columns))
        doubt += cut_block_square(pixels)
        observed.doubt.update(
            {n: doubt + square * pixels.rims.upright_rim_error(n) for n in pixels.sample.outline}
        )
    if file is None:
        for name, moved in pixels.drawn_changes.items():
            observed.independent[name] = moved.mean / rows
            if name in pixels.moving:
                observed.add_doubt([name], moved.doubt(region.columns, rows))
            else:  # noise of a known law
                doubt = moved.relative_doubt(region.columns, rows)
                observed.bound_factors[name] = 1.0 + doubt / 2.0
    else:
        observed.independent.update(
            {n: of_mean for n, (_, of_mean) in pixels.noise_read_back.items()}
        )
        name = pixels.files[0].name
        observed.independent[name] = file.own_sampling_square()
        observed.doubt[name] = observed.sampled_square(name)
        for name in pixels.moving:  # the growth by rounding is only known to a factor of two
            added, extra = (float(of_sets[pixels.stack_index(name)]) for of_sets in file.growth[1:])
            observed.independent[name] = added
            added += 2.0 * extra / file.block_rows
            observed.add_doubt([name], added)
    add_unsampled(pixels, observed)
    return observed


ALLOWANCE = 1.05
"""Factor from the change of the sample to the estimate; true changes rarely exceed the estimate."""

_PEAK, _NOISE_PEAK = 2.0, 3.0
"""Ratio of a chip's margin to the RMS of a smooth change, and of noise, that is still harmless."""

_LEAST_ESTIMATE = 1e-9
"""Estimate, in grey levels, for an effect of the scene that changes nothing in the sample."""

_UNDITHERED_FRACTION = 0.25
"""Fraction by which a file may enlarge a mean square where no noise spreads its rounding."""

_READ_FRACTION = 0.15  # largest distance from a chip's middle, in chips, at which it is read


def observe(pixels: SampledPixels, observable: Observable) -> SampledObservable:
    if observable == "image":
        observed = observe_image(pixels)
    else:
        # Without enhancement, pixels from a file are those of the profile, whole grey levels.
        is_plain = pixels.scene.model.enhancement == "none" and pixels.file is not None
        of_columns = observe_profile if observable == "profile" or is_plain else observe_signal
        observed = of_columns(pixels)
    if pixels.file is not None:
        observed.uncertainty = _UNDITHERED_FRACTION * pixels.file.undithered_fraction
        doubt = pixels.file.undithered_square()
        rims = pixels.rims.fraction  # without noise, these blocks may round differently
        square = rims * max(pixels.view.swing, pixels.table.contrast) ** 2 / 64.0
        at_rims = pixels.file.undithered_fraction * float(pixels.file.growth_at_rims(rims, square))
        doubt += at_rims if observable == "image" else at_rims / pixels.file.block_rows
        observed.add_doubt(pixels.names, doubt)
    return observed


def decision_margins(pixels: SampledPixels, signal: SampledObservable) -> tuple[float, float]:
    """Return the smallest distance of a chip from the threshold, and the step of columns there.

    Both are in levels of the signal. A chip on the wrong side of the threshold is misread; where
    the signal crosses it, noise larger than the step between columns makes false runs.
    """
    scene, sample = pixels.scene, pixels.sample
    signal_values = signal.complete / np.sqrt(sample.weights)
    low, high = float(signal_values.min()), float(signal_values.max())
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    middle = scene.model.start_time + sample.columns * camera.readout_time
    phase = (middle + camera.exposure_time / 2.0) * frequency % 1.0
    chips = signal_values[np.abs(phase - 0.5) < _READ_FRACTION]
    if high - low < 1.0 or not len(chips):
        return 0.0, 0.0
    scaled = ((signal_values - low) * (WHITE / (high - low))).astype(np.uint8)
    level, _ = cv2.threshold(scaled[None, :], 0, 255, cv2.THRESH_OTSU)
    threshold = low + (level + 0.5) * (high - low) / WHITE
    columns = max(camera.exposure_time / camera.readout_time, 1.0)
    return float(np.abs(chips - threshold).min()), (high - low) / columns


@dataclass(frozen=True, eq=False, slots=True)
class Estimates:
    """The change without each effect of a scene, in levels of the stretched profile."""

    sizes: Mapping[str, float]  # Estimates from the sample
    limits: Mapping[str, float]  # Upper bounds, with what the sample may have missed

    observed: SampledObservable | None
    """The sampled observable; None if no bound is known, so that nothing may be left out."""

    stretch: float  # Levels of the stretched profile per grey level
    factors: Mapping[str, float]  # Weight of an effect's change, at least 1
    unknown: str = ""  # Why no bound is known; every limit is then infinite
    # The estimates with effects that are switched off; None if none is
    complete: "Estimates | None" = None

    def errors_of(self, sets: Sequence[frozenset[str]]) -> list[float]:
        """Return bounds of the change, in levels, when each set of effects is left out."""
        if self.observed is None:
            return [math.inf if left_out else 0.0 for left_out in sets]
        changes = np.sqrt(self.observed.largest_squares(sets)).tolist()
        factors = [max((self.factors[name] for name in left_out), default=1.0) for left_out in sets]
        return [
            self.stretch * left_out * own for left_out, own in zip(factors, changes, strict=True)
        ]

    def error_without(self, effects: frozenset[str]) -> float:
        """Return a bound of the change without some effects, those switched off as well."""
        (error,) = (self.complete or self).errors_of([effects])
        return error


def estimates_of(view: PaperView, settings: SimulationSettings) -> Estimates:
    """Estimate the change without each effect; the settings may switch some on or off.

    The decision is refused for a light that is no code.
    """
    if settings.observable == "decision":
        check_code(view.scene.transmitter, instead="choose the signal, the profile or the image")
    try:
        estimates = _estimate_from_sample(view, settings.observable, EFFECTS)
    except ProjectionError:  # the simulation of this lens fails too
        unknown = {"distortion": math.inf}
        why = "the lens cannot be simulated"
        return Estimates(unknown, unknown, None, WHITE / view.swing, {}, why)
    force = settings.force
    if any(not is_on and name in estimates.sizes for name, is_on in force.items()):
        effects = tuple(effect for effect in EFFECTS if force.get(effect.name, True))
        without_off = _estimate_from_sample(view, settings.observable, effects)
        sizes, limits = (
            {**estimates.sizes, **without_off.sizes},
            {**estimates.limits, **without_off.limits},
        )
        estimates = replace(without_off, sizes=sizes, limits=limits, complete=estimates)
    if view.swing > FLAT_SPAN:
        return estimates
    # A change is then either far above the tolerance or absent from the sample.
    limits = dict.fromkeys(estimates.sizes, math.inf)
    why = "the stripes span less than a grey level"
    return replace(estimates, observed=None, limits=limits, unknown=why, complete=None)


def _estimate_from_sample(
    view: PaperView, observable: Observable, effects: tuple[Effect, ...]
) -> Estimates:
    pixels = sample_pixels(view, effects)
    of_signal = observable in ("signal", "decision")
    swing = signal_swing(pixels) if of_signal else view.swing
    stretch, factors = WHITE / swing, dict.fromkeys(pixels.names, 1.0)
    observed = observe(pixels, "signal" if of_signal else observable)
    if observable == "decision":
        margin, step = (max(distance, 1e-6) for distance in decision_margins(pixels, observed))
        stretch = _PEAK / margin
        for effect in (*pixels.noises, *pixels.files):  # their changes differ from column to column
            factors[effect.name] = _NOISE_PEAK / _PEAK * max(margin / step, 1.0)
    sizes, limits = {}, {}
    names = [effect.name for effect in pixels.effects]
    bounds = (
        np.sqrt(observed.largest_squares_if_added(names, np.eye(len(names)))).tolist()
        if names
        else []
    )
    for name, bound in zip(names, bounds, strict=True):
        unit = stretch * factors[name]
        allowance = 1.0 if name in observed.bound_factors else ALLOWANCE
        sizes[name] = (
            max(math.sqrt(observed.sampled_square(name)), _LEAST_ESTIMATE) * unit * allowance
        )
        limits[name] = max(bound * unit, sizes[name])
    return Estimates(sizes, limits, observed, stretch, factors)
