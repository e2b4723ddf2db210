"""The shutter speed that removes the bars from a picture at the same brightness."""

import numpy as np

from occ_model.results.bands import NO_BARS_DEPTH, Cure
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import duty
from occ_model.study.bands.least_depth import DepthOver
from occ_model.study.bands.shutter_speeds import shutter_speeds

_MAX_SPEEDS = 2

_SAMPLES = 65  # exposures within the error at which the depth is sampled


def cure_of(scene: Scene, exposure_error: float = 0.0) -> Cure:
    """Return the shutter speeds without bars, and the scene at the shortest of them.

    ``exposure_error``: standard deviation of the scene's exposure time in s.
    """
    over, frequency = DepthOver.of(scene), scene.transmitter.switching_frequency
    repeats = frequency / over.period

    def depth(exposure: float) -> float:
        exposures = np.array([exposure])
        return float((over.of_code(frequency * exposures) + over.flicker(exposures))[0])

    as_written = [
        each for each in reversed(shutter_speeds()) if depth(each.nominal) < NO_BARS_DEPTH
    ]
    kept = [each for each in as_written if depth(each.real) < NO_BARS_DEPTH]
    exposure = as_written[0].nominal if as_written else 1.0 / repeats
    cured = as_bright(scene, exposure)
    return Cure(
        repeats, duty(scene), _present_depth(scene, over, exposure_error),
        tuple(as_written[:_MAX_SPEEDS]), tuple(kept[:_MAX_SPEEDS]), cured,
    )  # fmt: skip


def _present_depth(scene: Scene, over: DepthOver, error: float) -> tuple[float, float]:
    """Return the range of the present depth of the bars in the lamp's own light."""
    exposure, frequency = scene.camera.exposure_time, scene.transmitter.switching_frequency
    ends = frequency * np.clip(exposure + np.array([-2.0, 2.0]) * error, 0.01 * exposure, None)
    # The swing is linear in the exposure between whole chips.
    nodes = np.arange(np.ceil(ends[0]), min(ends[1], ends[0] + over.period) + 0.5)
    chips = np.concatenate(
        [np.linspace(float(ends[0]), float(ends[1]), _SAMPLES), nodes[nodes < ends[1]]]
    )
    depths = over.swing_in(chips) / chips / duty(scene)
    return float(depths.min()), float(depths.max())


def as_bright(scene: Scene, exposure: float) -> Scene:
    """Return a scene at another exposure, as bright as ISO speed and then aperture allow."""
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
