"""The shutter speed that takes the bars out of a scene's picture, at the same brightness."""

from dataclasses import dataclass

import numpy as np

from occ_model.results.bands import SpeedDepth
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import speed_depths
from occ_model.study.bands.least_depth import DepthOver

_NAMED = 2


@dataclass(frozen=True, slots=True)
class Cure:
    """What takes the bars out of a picture.

    Parameters
    ----------
    repeats
        How often the lamp's light repeats, in Hz: bars vanish at whole multiples of one over it.
    speeds
        The shortest usual shutter speeds that show no bars, at most two.
    scene
        With the shortest of them, or the shortest exposure without bars of the lamp.
    """

    repeats: float
    speeds: tuple[SpeedDepth, ...]
    scene: Scene


def cure_of(scene: Scene) -> Cure:
    """Return the shutter speeds without bars, and the scene at the shortest of them."""
    repeats = scene.transmitter.switching_frequency / DepthOver.of(scene).period
    free = [each for each in speed_depths(scene) if each.is_free][::-1][:_NAMED]
    return Cure(repeats, tuple(free), as_bright(scene, free[0].nominal if free else 1.0 / repeats))


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
