"""The camera's response: from a column's lit fraction to its value between two levels."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.fit.least_squares import Tone
from occ_model.scene.scene import Scene

_BLACK_LEVEL = 0.5  # grey level below which dark columns are black
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

    Where the scene equalizes histograms, the response of an equalized picture is returned too. What
    ``check`` raises ends the fit that asks for a response.
    """
    tones = []
    for averaging in averagings:
        tone = _camera_tone(averaging, low / high if low > _BLACK_LEVEL else 0.0, check)
        tones.append(CameraTone(averaging, "none", tone))
        if scene.model.enhancement == "equalization":
            tones.append(CameraTone(averaging, "equalization", _equalized(tone), _RANK_RESOLUTION))
    return tones


def _camera_tone(averaging: str, black: float, check: Callable[[], object]) -> Tone:
    """Return the response of a panel whose dark pixel value is ``black`` relative to the lit one's.

    By equations (1) to (3) of the paper: light is the pixel value to the power of gamma.
    """

    def tone(lit: FloatArray, gamma: float) -> FloatArray:
        check()
        if averaging == "pixel-value":
            return lit
        dark = black**gamma
        return np.asarray(((dark + (1.0 - dark) * lit) ** (1.0 / gamma) - black) / (1.0 - black))

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
