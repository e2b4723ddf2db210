"""Photographs of messages that do not repeat, drawn without the model: one seed, one message."""

from dataclasses import dataclass

import cv2
import numpy as np
from simulated_photos import photo_of

import occ_model as occ

_ROWS = 24


@dataclass(frozen=True, eq=False)
class Message:
    """A photograph of a message."""

    photo: occ.Photo  # the photograph
    chips: str  # all chips that are sent, as a text of 0 and 1
    first: float  # chips that are sent before the middle of the first column's exposure
    columns_per_chip: float  # length of a chip

    def is_right(self, read: occ.ChipReading) -> bool:
        """Whether the chips read are those sent, at their place."""
        if abs(read.columns_per_chip / self.columns_per_chip - 1.0) > 0.05:
            return False
        near = round(self.first + read.start / self.columns_per_chip)
        starts = range(max(0, near - 1), near + 2)
        return any(self.chips[start : start + len(read.text)] == read.text for start in starts)


def message(seed: int, *, pauses: bool = False) -> Message:
    """Draw a message of 2.5 to 30 columns a chip and an exposure of 0.1 to 1.3 chips.

    A third are Manchester-coded. Half of the lamps are brighter than white; the light is uneven,
    the tone curve a gamma of 1 to 2.4; there is blur of up to 1.5 columns, and noise. With pauses
    the lamp is off for 2 to 6 chips after every 16 to 40, which are not a whole number.
    """
    random = np.random.default_rng([77, seed])
    columns_per_chip = float(np.exp(random.uniform(np.log(2.5), np.log(30.0))))
    columns = int(random.integers(300, 1500))
    count = int(columns / columns_per_chip) + 6
    chips = random.integers(0, 2, count)
    if seed % 3 == 0:
        chips = np.stack([chips, 1 - chips], axis=1).ravel()[:count]
    exposure = float(np.exp(random.uniform(np.log(0.1), np.log(1.3))))
    first = float(random.uniform(2.0, 3.0))
    place = first + np.arange(columns) / columns_per_chip
    whole = np.concatenate([[0.0], np.cumsum(chips)])
    ticks = np.arange(count + 1, dtype=np.float64)
    if pauses:
        ticks, whole, chips = _insert_pauses(random, ticks, whole, chips)
    ends = [np.interp(place + half, ticks, whole) for half in (-0.5 * exposure, 0.5 * exposure)]
    lit = (ends[1] - ends[0]) / exposure
    image = _photograph(random, lit)
    return Message(photo_of(image), "".join(map(str, chips)), first, columns_per_chip)


def _insert_pauses(
    random: np.random.Generator, ticks: np.ndarray, whole: np.ndarray, chips: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Insert pauses into the light, and the nearest whole number of dark chips into the chips."""
    pause_after = np.cumsum(random.integers(16, 41, len(chips)))
    for at in pause_after[pause_after < len(chips)][::-1].tolist():
        length = float(random.uniform(2.0, 6.0))
        ticks = np.concatenate([ticks[: at + 1], ticks[at:] + length])
        whole = np.concatenate([whole[: at + 1], whole[at:]])
        dark = np.zeros(round(length), dtype=chips.dtype)
        chips = np.concatenate([chips[:at], dark, chips[at:]])
    return ticks, whole, chips


def _photograph(random: np.random.Generator, lit: np.ndarray) -> np.ndarray:
    """Add surroundings, uneven light, a tone curve, blur and noise, and clip at white."""
    columns = len(lit)
    peak = float(random.uniform(0.1, 0.9) if random.integers(2) else random.uniform(1.0, 2.5))
    off = np.linspace(-1.0, 1.0, columns) - random.uniform(-0.5, 0.5)
    uneven = 1.0 - random.uniform(0.0, 0.5) * off**2
    light = np.clip((lit + random.uniform(0.0, 0.1)) * uneven * peak, 0.0, 1.0)
    values = 255.0 * light ** (1.0 / random.uniform(1.0, 2.4))
    blur = float(random.uniform(0.1, 1.5))
    blurred = cv2.GaussianBlur(values[None], (0, 0), blur, borderType=cv2.BORDER_REPLICATE)
    noise = float(np.exp(random.uniform(np.log(0.4), np.log(80.0))))
    noisy = blurred + noise * random.standard_normal((_ROWS, columns))
    return np.clip(np.rint(noisy), 0, 255).astype(np.uint8)
