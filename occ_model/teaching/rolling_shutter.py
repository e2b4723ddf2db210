"""Returns some columns' exposures on the LED's waveform: how a rolling shutter makes stripes."""

import numpy as np

from occ_model.camera.exposure import on_time
from occ_model.results.teaching import RollingShutter
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.packet import sent_chips

_CHIPS = 4  # chips that the shown columns begin in

_MAX_CHIPS = 400  # maximum number of chips that a drawing resolves; only these of a longer exposure


def rolling_shutter(scene: Scene, shown: int = 25) -> RollingShutter:
    """Return the exposures of up to ``shown`` first columns, which begin within four chips."""
    check_scene(scene)
    camera, period = scene.camera, scene.transmitter.switching_period
    last = min(camera.columns - 1, max(int(_CHIPS * period / camera.readout_time), 1))
    columns = np.unique(np.linspace(0, last, min(shown, last + 1)).round().astype(np.intp))
    starts = np.multiply(columns, camera.readout_time, dtype=np.float64)
    chips = sent_chips(scene.transmitter)
    phase = (scene.model.start_time * scene.transmitter.switching_frequency) % len(chips)
    first = int(phase)
    needed = (float(starts[-1]) + camera.exposure_time) / period
    count = int(min(np.ceil(needed) + 1, _MAX_CHIPS))
    return RollingShutter(
        columns=columns,
        starts=starts,
        exposure_time=camera.exposure_time,
        lit_fraction=on_time(scene)[columns] / camera.exposure_time,
        edges=np.asarray((first - phase + np.arange(count + 1)) * period, dtype=np.float64),
        lit=chips[(first + np.arange(count)) % len(chips)],
    )
