"""How much leaving effects out changes what is observed of a scene, estimated from a sample."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np

from occ_model.camera.photometry import FLAT_SPAN, WHITE
from occ_model.effects.effect import Effect
from occ_model.effects.observed import Observed
from occ_model.effects.observed_image import observed_image, observed_profile
from occ_model.effects.observed_signal import observed_signal, signal_swing
from occ_model.effects.paper_view import PaperView
from occ_model.effects.registry import EFFECTS
from occ_model.effects.sampled_pixels import SampledPixels, sampled_pixels
from occ_model.errors import ProjectionError
from occ_model.scene.simulation_settings import Observable, SimulationSettings

ALLOWANCE = 1.05
"""Factor on the change that a sample shows, so that hardly any exceeds its estimate."""

_PEAK, _NOISE_PEAK = 2.0, 3.0
"""Root mean squares of a smooth change, and of noise, that are to stay within a chip's margin."""

_LEAST_ESTIMATE = 1e-9
"""Estimate, in grey levels, of a scene's effect that the sample does not show."""

_UNDITHERED_FRACTION = 0.25
"""Fraction of a mean square by which a file without noise may change it further."""

_READ_FRACTION = 0.15  # fraction of a chip from its middle at which it is read


def observed(pixels: SampledPixels, observable: Observable) -> Observed:
    if observable == "image":
        found = observed_image(pixels)
    else:
        found = observed_profile(pixels) if observable == "profile" else observed_signal(pixels)
    if pixels.file is not None:
        found.unsure = _UNDITHERED_FRACTION * pixels.file.undithered_fraction
        doubt = pixels.file.undithered()
        rims = pixels.rims.fraction  # where no noise spreads it, a rim's blocks round otherwise
        square = rims * max(pixels.view.swing, pixels.contrast) ** 2 / 64.0
        at_rims = pixels.file.undithered_fraction * pixels.file.added_at_a_rim(rims, square)
        doubt += at_rims if observable == "image" else at_rims / pixels.file.block_rows
        found.add_doubt(pixels.names, doubt)
    return found


def margins(pixels: SampledPixels, signal: Observed) -> tuple[float, float]:
    """Return the chips' distance from the threshold, and the steps between columns near it.

    Both in levels of the signal. A chip that passes the threshold is read wrongly; where the signal
    crosses it, noise larger than the step between columns makes false runs.
    """
    scene, sample = pixels.scene, pixels.sample
    seen = signal.complete / np.sqrt(sample.weights)
    low, high = float(seen.min()), float(seen.max())
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    middle = scene.model.start_time + sample.columns * camera.readout_time
    phase = (middle + camera.exposure_time / 2.0) * frequency % 1.0
    chips = seen[np.abs(phase - 0.5) < _READ_FRACTION]
    if high - low < 1.0 or not len(chips):
        return 0.0, 0.0
    scaled = ((seen - low) * (WHITE / (high - low))).astype(np.uint8)
    found, _ = cv2.threshold(scaled[None, :], 0, 255, cv2.THRESH_OTSU)
    threshold = low + (found + 0.5) * (high - low) / WHITE
    across = max(camera.exposure_time / camera.readout_time, 1.0)
    return float(np.abs(chips - threshold).min()), (high - low) / across


@dataclass(frozen=True, eq=False, slots=True)
class Estimates:
    """What leaving out each effect of a scene changes, in levels of the stretched profile."""

    sizes: Mapping[str, float]  # As the sample shows it
    limits: Mapping[str, float]  # With what it may not show

    seen: Observed | None
    """The observable, None where no set of effects is known to be small enough."""

    stretch: float  # Levels of the stretched profile per grey level
    factors: Mapping[str, float]  # By what an effect's change counts more than by its size
    unknown: str = ""  # Why no change is known; every limit is then infinite

    def errors_of(self, sets: Sequence[frozenset[str]]) -> list[float]:
        """Return the largest changes by leaving out sets of effects together, in levels."""
        if self.seen is None:
            return [math.inf if left_out else 0.0 for left_out in sets]
        most = np.sqrt(self.seen.together(sets)).tolist()
        factors = [max((self.factors[name] for name in one), default=1.0) for one in sets]
        return [self.stretch * one * own for one, own in zip(factors, most, strict=True)]


def estimates_of(view: PaperView, settings: SimulationSettings) -> Estimates:
    """Estimate what leaving out each effect changes, with some switched by hand."""
    try:
        found = _estimates_of(view, settings.observable, EFFECTS)
    except ProjectionError:  # the simulation refuses the lens
        unknown = {"distortion": math.inf}
        why = "the lens cannot be simulated"
        return Estimates(unknown, unknown, None, WHITE / view.swing, {}, why)
    force = settings.force
    if any(not on and name in found.sizes for name, on in force.items()):
        kept = tuple(effect for effect in EFFECTS if force.get(effect.name, True))
        own = _estimates_of(view, settings.observable, kept)
        sizes, limits = {**found.sizes, **own.sizes}, {**found.limits, **own.limits}
        found = replace(own, sizes=sizes, limits=limits)
    if view.swing > FLAT_SPAN:
        return found
    # Far above the tolerance, or hidden to a sample, which then determines nothing.
    limits = dict.fromkeys(found.sizes, math.inf)
    why = "the stripes span less than a grey level"
    return replace(found, seen=None, limits=limits, unknown=why)


def _estimates_of(
    view: PaperView, observable: Observable, effects: tuple[Effect, ...]
) -> Estimates:
    pixels = sampled_pixels(view, effects)
    of_signal = observable in ("signal", "decision")
    swing = signal_swing(pixels) if of_signal else view.swing
    stretch, factors = WHITE / swing, dict.fromkeys(pixels.names, 1.0)
    seen = observed(pixels, "signal" if of_signal else observable)
    if observable == "decision":
        margin, step = (max(found, 1e-6) for found in margins(pixels, seen))
        stretch = _PEAK / margin
        for effect in (*pixels.noises, *pixels.files):  # which differ from column to column
            factors[effect.name] = _NOISE_PEAK / _PEAK * max(margin / step, 1.0)
    sizes, limits = {}, {}
    names = [effect.name for effect in pixels.effects]
    most = np.sqrt(seen.of_subsets(names, np.eye(len(names)))).tolist() if names else []
    for name, of_sample in zip(names, most, strict=True):
        unit = stretch * factors[name]
        allowance = 1.0 if name in seen.known else ALLOWANCE
        sizes[name] = max(math.sqrt(seen.shown(name)), _LEAST_ESTIMATE) * unit * allowance
        limits[name] = max(of_sample * unit, sizes[name])
    return Estimates(sizes, limits, seen, stretch, factors)
