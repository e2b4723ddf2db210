"""A pixel is full when it holds no more electrons."""

import numpy as np

from occ_model.camera.sensor import saturation_value
from occ_model.effects.effect import PixelEffect, Values
from occ_model.effects.paper_view import reachable_luminances, shown_value
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable


class FullWell(PixelEffect):
    """A pixel holds at most its full well of electrons; more light changes nothing.

    At low ISO speeds the well is full before the pixel value reaches 255.
    """

    name = "full-well"
    label = "Full well"
    parameters = ("full_well",)

    def bound(self, scene: Scene, observable: Observable) -> float:  # noqa: ARG002 - not averaged out
        """Bound the change by what the brightest column has beyond a full well."""
        brightest = shown_value(reachable_luminances(scene)[1], scene)
        return max(brightest - saturation_value(scene), 0.0)

    def apply(self, scene: Scene, values: Values) -> Values:
        """Cut off what is beyond a full well."""
        full = np.asarray(saturation_value(scene), dtype=values.dtype)
        return np.minimum(values, full)
