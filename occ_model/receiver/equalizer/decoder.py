"""The equalizer: the exposure undone, then the paper's threshold, run lengths and headers.

Beyond the paper, it knows the exposure time and the readout time, and about how long a chip is. It
needs no list of codes: the data may be any.
"""

from dataclasses import replace

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.equalizer.undo_exposure import undo_exposure
from occ_model.receiver.light import in_light
from occ_model.receiver.signal import why_flat
from occ_model.receiver.threshold.decoder import read_signal as read_by_threshold
from occ_model.results import DecodeResult
from occ_model.scene.scene import Scene

_CURVE_UNKNOWN = (
    "The picture is enhanced by {enhancement}, which hides how bright each column was, so that the "
    "exposure cannot be undone exactly; without the enhancement it can."
)

_MOST_COLUMNS = 0.25
"""Longest exposure that is undone, as a share of the picture."""


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the code from a signal whose exposure is undone.

    Parameters
    ----------
    signal : ndarray of float64, shape (columns,)
        Mean grey level of each column.
    scene
        Its number of bits, switching frequency, exposure time, readout time, averaging, gamma and
        enhancement are used, and the way to undo the exposure.

    Returns
    -------
    DecodeResult
        With the light that is left when the exposure is undone, and the threshold decoder's steps.
    """
    result = DecodeResult(DECODER.name, signal=signal, failure=why_flat(signal))
    if result.failure is not None:
        return result
    camera = scene.camera
    exposure = camera.exposure_time / camera.readout_time
    if exposure > _MOST_COLUMNS * len(signal):
        return replace(
            result,
            failure=f"An exposure lasts {exposure:.3g} columns of the {len(signal)} in the panel's "
            "image: too few are left to undo it.",
        )
    light = in_light(signal, scene)
    chip = scene.transmitter.switching_period / camera.readout_time
    undone = undo_exposure(light.values, exposure, chip, scene.receiver.equalizer)
    equalized = undone * WHITE
    read = read_by_threshold(equalized, scene)
    failure = read.failure
    if failure is not None and light.is_estimated:
        failure += " " + _CURVE_UNKNOWN.format(enhancement=scene.model.enhancement)
    return replace(read, decoder=DECODER.name, signal=signal, equalized=equalized, failure=failure)


DECODER = Decoder(
    "equalizer", "Equalizer: the exposure undone, then as the paper", read_signal, is_quick=False
)
