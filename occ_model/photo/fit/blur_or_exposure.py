"""Fit an exposure that may be mistaken for blur: edges show the width of both together."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.photo.fit.averaged_fits import distinct
from occ_model.photo.fit.blurred_light import BlurShape
from occ_model.photo.fit.joint_fit import JointFit, JointModel

_MOST_COLUMNS = 12.0  # exposure in columns below which blur may be taken for it
_BLURS = (0.2, 0.7, 1.1, 1.5)  # standard deviations of blur, in columns, that are tried

_BLUR_FRACTIONS: dict[BlurShape | None, tuple[float, ...]] = {
    None: (0.9,),
    "box": (0.1, 0.5, 0.75),
    "exponential": (0.1, 0.5, 0.75),
}
"""Fractions of an edge's variance due to blur from which fits start, by the shape of the blur. A
box of blur and an exposure look alike, and each shape has several minima: starts at one half alone
took a blur of 1.3 columns and an exposure of 2.2 for one of 1.1 and 3.5, with a larger misfit."""

_LAST_ROUNDS = 10
_SHORTEST = 0.2  # shortest exposure in columns to start from


@dataclass(frozen=True, eq=False, slots=True)
class Possible:
    """A model's fit, and the number of its steps once the noise is known."""

    model: JointModel
    fit: JointFit
    rounds: int = 1

    def again(self) -> list[JointFit]:
        """Fit again, the noise having been estimated, also with each shape of the blur.

        Each minimum counts once, however many starts end in it.
        """
        free = self.model.fit(self.fit.values, rounds=self.rounds)
        if free.values[1] >= _MOST_COLUMNS * free.values[0]:
            return [free]
        found = {shape: self._shared(free.values, shape) for shape in _BLUR_FRACTIONS}
        found["box"] += self._exchanged(found["box"])
        found[None].append(free)
        best = min((fit for fits in found.values() for fit in fits), key=lambda fit: fit.misfit)
        for shape, fits in found.items():
            # A blur of the wrong shape bends the tone curve: each begins from the best one, too.
            fits.append(self.model.fit(best.values, rounds=_LAST_ROUNDS, shape=shape))
        return [fit for fits in found.values() for fit in distinct(fits)]

    def _exchanged(self, boxes: Sequence[JointFit]) -> list[JointFit]:
        """Fit with exposure and blur exchanged: two boxes make the same edge in either order."""
        found = min(boxes, key=lambda fit: fit.misfit).values
        step, exposure, blur = float(found[0]), float(found[1]), float(found[7])
        starts = []
        # Blur far below a column is hardly seen, so that a box of a column is exchanged, too.
        for box in (max(math.sqrt(12.0) * blur, _SHORTEST), 1.0):
            values = found.copy()
            values[1], values[7] = step * box, exposure / step / math.sqrt(12.0)
            starts.append(values)
        return [self.model.fit(one, rounds=_LAST_ROUNDS, shape="box") for one in starts]

    def _shared(self, values: FloatArray, shape: BlurShape | None) -> list[JointFit]:
        """Fit with another shape of the blur, starting from its fractions of the edges' width."""
        columns = float(values[1] / values[0])
        width = columns**2 / 12.0 + float(values[7]) ** 2
        return [
            self.model.fit(_with_blur(values, math.sqrt(share * width)), rounds=4, shape=shape)
            for share in _BLUR_FRACTIONS[shape]
        ]


def possible_near(models: Sequence[JointModel], values: FloatArray) -> list[Possible]:
    """Fit each model near an exposure; a short one with every blur, which it may be taken for."""
    columns = float(values[1] / values[0])
    if columns > _MOST_COLUMNS:
        return [Possible(one, one.fit(one.adapted(values))) for one in models]
    found = []
    for model in models:
        here = model.adapted(values)
        others = [_with_blur(here, blur) for blur in _BLURS]
        if not model.is_wide:
            # Each blur starts from what is usual of all else: tone and switching can make up for
            # it. Where gamma is asked for, it must not start anew.
            others = [model.with_usual(other) for other in others]
        starts = [here, *others]
        fits = [model.fit(start, rounds=5) for start in starts]
        best = min(fits, key=lambda fit: fit.misfit)
        found.append(Possible(model, best, _LAST_ROUNDS))
    return found


def _with_blur(values: FloatArray, blur: float) -> FloatArray:
    """Set the blur, and the exposure that leaves the edges' width as it is."""
    values = values.copy()
    step = float(values[0])
    width = (values[1] / step) ** 2 + 12.0 * (values[7] ** 2 - blur**2)
    values[1] = step * math.sqrt(max(float(width), _SHORTEST**2))
    values[7] = blur
    return values
