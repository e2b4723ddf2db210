"""The equalizer: the exposure undone, then the paper's threshold, run lengths and headers.

Beyond the paper, it knows the exposure time and the readout time, and about how long a chip is. It
needs no list of codes: the data may be any.
"""

from collections import Counter
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.equalizer.undo_exposure import undo_exposure
from occ_model.receiver.light import in_light
from occ_model.receiver.read_payload import with_bits
from occ_model.receiver.signal import why_flat
from occ_model.receiver.threshold.decoder import read_stripes as read_by_threshold
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.scheme import scheme_of

_CURVE_UNKNOWN = (
    "The picture is enhanced by {enhancement}, which hides how bright each column was, so that the "
    "exposure cannot be undone exactly; without the enhancement it can."
)

_MAX_VOTES = 15  # packets that are compared; more take time and change nothing
_MAX_EXPOSURE_FRACTION = 0.25  # of the columns: the longest exposure that is undone


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the code from a signal whose exposure is undone.

    The result holds the deconvolved light and the threshold decoder's steps.
    """
    result = DecodeResult(DECODER.name, signal=signal, failure=why_flat(signal))
    if result.failure is not None:
        return result
    camera = scene.camera
    exposure = camera.exposure_time / camera.readout_time
    if exposure > _MAX_EXPOSURE_FRACTION * len(signal):
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
    read = _agreed(read, scene)
    failure = read.failure
    if failure is not None and light.is_estimated:
        failure += " " + _CURVE_UNKNOWN.format(enhancement=scene.model.enhancement)
    return replace(read, decoder=DECODER.name, signal=signal, equalized=equalized, failure=failure)


def _agreed(read: DecodeResult, scene: Scene) -> DecodeResult:
    """Read every packet that the picture shows, and keep what most of them say.

    The paper reads the first one alone; errors of undone light differ from packet to packet.
    """
    if scene.transmitter.pattern:
        return read
    scheme = scheme_of(scene.transmitter)
    length = scheme.length + len(HEADER)  # the next header ends a packet of the paper's
    starts = read.headers[:_MAX_VOTES]
    frames = [scheme.decode(read.chips[start : start + length]) for start in starts]
    votes = Counter(
        tuple(frame.bits.tolist())
        for frame in frames
        if frame.failure is None and len(frame.bits) == scheme.bits
    ).most_common(2)
    if not votes:
        return read
    (bits, most), *others = votes
    if others and others[0][1] == most:
        return replace(
            read,
            code=None,
            payload="",
            failure="The packets in the picture do not agree: two different payloads were read "
            f"from {most} of them each.",
        )
    agreed = Framed(read.headers, np.array(bits, dtype=np.uint8))
    return with_bits(read, agreed, scene)


DECODER = Decoder(
    "equalizer", "Equalizer: the exposure undone, then as the paper", read_signal, is_quick=False
)
