"""The camera's response: from a column's lit fraction to its value between two levels."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene

_BLACK_LEVEL = 0.5  # grey level below which dark columns are black
_LEAST_LIGHT = 1e-3  # fraction of a lit column's light below which the curve's slope is bounded
_NEAR = 0.02  # distance within which neighbours in rank are counted, over the range of values

AVERAGINGS = ("pixel-value", "light")


class PixelResponse:
    """A camera's response: from lit fractions and gamma to pixel values between any two levels.

    This one is linear.
    """

    def __call__(self, lit: FloatArray, gamma: float) -> FloatArray:  # noqa: ARG002
        return lit

    def slopes(self, lit: FloatArray, gamma: float, by_timing: FloatArray) -> FloatArray:
        """Return the values' slopes over the timing's three fields and gamma, shape (4, columns).

        ``by_timing``: shape (3, columns), those of the lit fractions.
        """
        by_lit, by_gamma = self.rates(lit, gamma)
        return np.concatenate([by_lit * by_timing, by_gamma[None]])

    def rates(self, lit: FloatArray, gamma: float) -> tuple[FloatArray, FloatArray]:  # noqa: ARG002
        """Return the values' slopes over the lit fractions and over gamma."""
        return np.ones_like(lit), np.zeros_like(lit)


@dataclass(frozen=True, slots=True)
class CameraResponse:
    """What a camera averages over an exposure, how it enhances its picture, and its response."""

    averaging: str
    enhancement: str
    response: PixelResponse


def camera_responses(
    scene: Scene, averagings: Sequence[str], low: float, high: float
) -> list[CameraResponse]:
    """Return the responses that a scene's camera can have, for stripes between two grey levels.

    Where the scene equalizes histograms, the response of an equalized picture is returned too.
    """
    found = []
    for averaging in averagings:
        black = low / high if low > _BLACK_LEVEL else 0.0
        response = _AveragedLight(black) if averaging == "light" else PixelResponse()
        found.append(CameraResponse(averaging, "none", response))
        if scene.model.enhancement == "equalization":
            found.append(CameraResponse(averaging, "equalization", _Ranks(response)))
    return found


@dataclass(frozen=True)
class _AveragedLight(PixelResponse):
    """The response to averaged light; ``black``: the dark pixel value over the lit one's.

    By equations (1) to (3) of the paper: light is the pixel value to the power of gamma.
    """

    black: float

    def __call__(self, lit: FloatArray, gamma: float) -> FloatArray:
        dark = self.black**gamma
        value = (dark + (1.0 - dark) * lit) ** (1.0 / gamma)
        return np.asarray((value - self.black) / (1.0 - self.black))

    def rates(self, lit: FloatArray, gamma: float) -> tuple[FloatArray, FloatArray]:
        dark = self.black**gamma
        # At black the slope of the curve is infinite, but no column sees so little of a chip.
        light = np.maximum(dark + (1.0 - dark) * lit, _LEAST_LIGHT)
        value = light ** (1.0 / gamma) / (1.0 - self.black)
        by_light = value / (gamma * light)
        darker = dark * np.log(self.black) * (1.0 - lit) if self.black else 0.0
        return by_light * (1.0 - dark), by_light * darker - value * np.log(light) / gamma**2


@dataclass(frozen=True)
class _Ranks(PixelResponse):
    """The response of a picture with equalized histogram: each column's rank."""

    response: PixelResponse  # that of the picture before it was equalized

    def __call__(self, lit: FloatArray, gamma: float) -> FloatArray:
        values = np.round(self.response(lit, gamma), 3)  # grey levels are no finer
        in_order = np.sort(values)
        rank = np.searchsorted(in_order, values, side="right").astype(np.float64)
        least, most = float(rank.min()), float(rank.max())
        return np.asarray((rank - least) / (most - least)) if most > least else values

    def slopes(self, lit: FloatArray, gamma: float, by_timing: FloatArray) -> FloatArray:
        """Return the slopes of the ranks.

        The rank of a value rises by the density of values near it, times the difference of its rise
        to theirs.
        """
        values = self.response(lit, gamma)
        order = np.argsort(values)
        in_order = values[order]
        first, last = (np.searchsorted(in_order, values + part) for part in (-_NEAR, _NEAR))
        near = np.maximum(last - first, 1)
        slopes = self.response.slopes(lit, gamma, by_timing)
        sums = np.cumsum(slopes[:, order], axis=1)
        sums = np.concatenate([np.zeros((len(sums), 1)), sums], axis=1)
        above = slopes - (sums[:, last] - sums[:, first]) / near
        return np.asarray(above * near / (2.0 * _NEAR * len(values)))
