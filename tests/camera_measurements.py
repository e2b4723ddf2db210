"""An example of a measured camera, for tests of what shows it."""

import math

import numpy as np

from occ_model.results.camera import CameraMeasurement


def make_measurement(mains: float = 50.0, reasons: tuple[str, ...] = ()) -> CameraMeasurement:
    """Return a measurement of 27.5 us a line, with 2.97 bars in each of six tiles."""
    bars = 27.5e-6 * 1080 * 2.0 * mains
    along = np.arange(120) / 120
    return CameraMeasurement(
        mains_frequency=mains,
        bars=bars,
        readout_time=27.5e-6,
        frame_readout_time=27.5e-6 * 1080,
        uncertainties={"bars": 0.01, "readout_time": 1e-7, "frame_readout_time": 1e-4},
        scan_axis="lines",
        lines=1080,
        pictures=2,
        depth=0.4,
        longest_exposure=None,
        waves=np.array([0.4 * np.cos(2.0 * math.pi * bars * along + tile) for tile in range(6)]),
        reasons=reasons,
    )
