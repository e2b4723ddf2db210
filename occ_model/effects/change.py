"""How much leaving effects out changes what is observed of a scene, estimated from a sample."""

import cv2
import numpy as np

from occ_model.camera.photometry import WHITE
from occ_model.effects.observed import Observed
from occ_model.effects.observed_image import observed_image, observed_profile
from occ_model.effects.observed_signal import observed_signal
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.scene.simulation_settings import Observable

_UNDITHERED_FRACTION = 0.25
"""Share of a mean square by which a file without noise may change it further."""

_READ_FRACTION = 0.15
"""Share of a chip from its middle at which it is read."""


def observed(pixels: SampledPixels, observable: Observable) -> Observed:
    """Return what is observed of the sample, and how it changes."""
    if observable == "image":
        found = observed_image(pixels)
    else:
        found = observed_profile(pixels) if observable == "profile" else observed_signal(pixels)
    if pixels.file is not None:
        found.unsure = _UNDITHERED_FRACTION * pixels.file.undithered_share
        doubt = pixels.file.undithered()
        rims = pixels.rim_share  # where no noise spreads it, a rim's blocks round otherwise
        square = rims * max(pixels.view.swing, pixels.contrast) ** 2 / 64.0
        at_rims = pixels.file.undithered_share * pixels.file.added_at_rims(rims, square)
        doubt += at_rims if observable == "image" else at_rims / pixels.file.block_rows
        for name in pixels.names:
            found.doubt[name] = found.doubt.get(name, 0.0) + doubt
    return found


def margins(pixels: SampledPixels, signal: Observed) -> tuple[float, float]:
    """Return how far chips keep from the threshold, and the steps between columns near it.

    Both in levels of the signal. A chip that passes the threshold is read wrongly; where the
    signal crosses it, noise larger than the step between columns makes runs that are none.
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
