"""Pictures of a wall with one flash a frame, drawn without the model: one seed, one picture."""

import math
from dataclasses import dataclass

import cv2
import numpy as np

from photo_world.photograph import compress
from photo_world.tone_curves import unknown_curve


@dataclass(frozen=True)
class FlashPicture:
    """A picture whose rows are the lines, with its times in seconds."""

    image: np.ndarray
    readout_time: float
    flash: float
    exposure: float


def flash_picture(seed: int) -> FlashPicture:
    """Draw a band of a flash that is longer or shorter than the exposure, all of it in view."""
    random = np.random.default_rng([seed, 4711])
    rows, columns = int(random.integers(500, 1500)), int(random.integers(300, 900))
    readout = math.exp(random.uniform(math.log(7e-6), math.log(40e-6)))
    total = random.uniform(0.15, 0.6) * rows
    shorter = random.uniform(0.03, 0.4) * total
    flash_lines, exposure_lines = total - shorter, shorter
    if random.random() < 0.5:
        flash_lines, exposure_lines = exposure_lines, flash_lines
    first = random.uniform(0.05 * rows, 0.95 * rows - total)
    # What a line gathers of the flash, exactly: how long it lasts during the exposure.
    line = np.arange(rows, dtype=np.float64)
    begin = first + exposure_lines  # of the flash, in lines
    shared = np.minimum(line + exposure_lines, begin + flash_lines) - np.maximum(line, begin)
    lit = np.maximum(shared, 0.0)[:, None] / shorter
    down, across = np.mgrid[0:rows, 0:columns] / max(rows, columns) - 0.5
    wall = np.exp(random.uniform(-0.8, 0.8) * down + random.uniform(-0.8, 0.8) * across)
    wall *= 1.0 - random.uniform(0.0, 0.8) * (down**2 + across**2)
    rough = cv2.GaussianBlur(random.standard_normal((rows, columns)), (0, 0), 2.0)
    wall *= np.exp(0.05 * rough / rough.std())
    light = wall * (random.uniform(0.0, 0.08) + random.uniform(0.15, 0.8) * lit)
    light = cv2.GaussianBlur(light, (0, 0), random.uniform(0.3, 1.0))
    well = math.exp(random.uniform(math.log(800.0), math.log(6000.0)))
    seen = np.clip(random.poisson(np.clip(light, 0.0, 2.0) * well) / well, 0.0, 1.0)
    image = np.rint(255.0 * unknown_curve(random)(seen)).astype(np.uint8)
    image = compress(image, int(random.integers(75, 96)))
    return FlashPicture(image, readout, flash_lines * readout, exposure_lines * readout)
