"""The camera's response: from a column's lit fraction to its value between two levels."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import ColumnLight, level_values, panel_values
from occ_model.photo.fit.least_squares import Tone
from occ_model.scene.scene import Scene

_BRIGHT = 1000.0  # luminance of the lit panel in cd/m2; only ratios to it matter
_DARKEST = 0.5  # grey level below which dark columns are black

_STEADY_LIGHT = np.ones(1)

_RANK_RESOLUTION = 0.5  # change of the timing in columns that changes the columns' ranks noticeably

AVERAGINGS = ("pixel-value", "light")


@dataclass(frozen=True, slots=True)
class CameraTone:
    """A camera's response to light, with the enhancement of its picture."""

    averaging: str
    enhancement: str
    tone: Tone
    # Smallest change of the timing, in columns, that changes the response: ranks are discrete.
    rank_resolution: float = 0.0


def camera_tones(
    scene: Scene,
    averagings: Sequence[str],
    low: float,
    high: float,
    check: Callable[[], object] = lambda: None,
) -> list[CameraTone]:
    """Return the responses that a scene's camera can have, for stripes between two grey levels.

    Where the scene equalizes histograms, the response of an equalized picture is returned too. With
    gamma the levels give the luminance of the dark panel relative to the lit one. What ``check``
    raises ends the fit that asks for a response.
    """
    tones = []
    for averaging in averagings:
        tone = _camera_tone(scene.replace(averaging=averaging), low, high, check)
        tones.append(CameraTone(averaging, "none", tone))
        if scene.model.enhancement == "equalization":
            tones.append(CameraTone(averaging, "equalization", _equalized(tone), _RANK_RESOLUTION))
    return tones


def _camera_tone(scene: Scene, low: float, high: float, check: Callable[[], object]) -> Tone:
    @lru_cache(maxsize=4)  # a fit evaluates the same gamma many times
    def levels(gamma: float) -> tuple[Scene, float, float]:
        dark = (low / high) ** gamma if low > _DARKEST else 0.0
        camera = scene.replace(
            gamma=gamma,
            reflectance=1.0,
            illuminance=math.pi * _BRIGHT * dark,
            luminance=_BRIGHT * (1.0 - dark),
        )
        black, white = level_values(camera).tolist()
        return camera, black, white

    def tone(lit: FloatArray, gamma: float) -> FloatArray:
        check()
        camera, black, white = levels(gamma)
        values = panel_values(camera, ColumnLight(lit, _STEADY_LIGHT))
        return np.asarray((values - black) / (white - black))

    return tone


def _equalized(tone: Tone) -> Tone:
    """Return the response of a picture with equalized histogram: each column's rank."""

    def of_rank(lit: FloatArray, gamma: float) -> FloatArray:
        values = np.round(tone(lit, gamma), 3)  # grey levels are no finer
        in_order = np.sort(values)
        rank = np.searchsorted(in_order, values, side="right").astype(np.float64)
        least, most = float(rank.min()), float(rank.max())
        return np.asarray((rank - least) / (most - least)) if most > least else values

    return of_rank
