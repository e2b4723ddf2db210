"""The shutter speed that takes the bars out of a scene's picture, at the same brightness."""

import numpy as np

from occ_model.results.bands import BARELY, Cure
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.bands.least_depth import DepthOver
from occ_model.study.bands.shutter_speeds import shutter_speeds

_NAMED = 2


def cure_of(scene: Scene) -> Cure:
    """Return the shutter speeds without bars, and the scene at the shortest of them."""
    over, frequency = DepthOver.of(scene), scene.transmitter.switching_frequency
    repeats = frequency / over.period

    def depth(exposure: float) -> float:
        exposures = np.array([exposure])
        return float((over.of_code(frequency * exposures) + over.flicker(exposures))[0])

    as_written = [each for each in reversed(shutter_speeds()) if depth(each.nominal) < BARELY]
    kept = [each for each in as_written if depth(each.real) < BARELY]
    exposure = as_written[0].nominal if as_written else 1.0 / repeats
    cured = as_bright(scene, exposure)
    return Cure(repeats, tuple(as_written[:_NAMED]), tuple(kept[:_NAMED]), cured)


def as_bright(scene: Scene, exposure: float) -> Scene:
    """Return a scene of another exposure time whose picture is as bright, if a camera can.

    The ISO speed follows within the usual ones, then the aperture.
    """
    camera = scene.camera
    low, high = quantity("iso").slider
    wanted = camera.iso * camera.exposure_time / exposure
    iso = float(np.clip(wanted, min(low, camera.iso), max(high, camera.iso)))
    f_number = quantity("f_number")
    stopped = camera.f_number * float(np.sqrt(iso / wanted))
    return scene.replace(
        exposure_time=exposure, iso=iso,
        f_number=float(np.clip(stopped, f_number.low, f_number.high)),
    )  # fmt: skip
