"""Read colour shift keying: each symbol is the point nearest to the light of the three LEDs.

No point is dark, and all have the same total power: the sum of the colours shows the dark header,
and so where a packet starts. An exposure longer than a symbol adds up the light of several; least
squares solves for the light of each symbol of the packet from all columns.
"""

import math
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.scene.csk import HEADER, PARTS, POINTS, bits_of, symbols_of
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import code_of

_STARTS = 16  # starts that are tried for each symbol of a packet
_LEAST_CORRELATION = 0.7  # least correlation of total light with a packet's for a header to be seen
_WORST_CONDITION = 1e3  # condition number beyond which the equations enlarge noise too much


def read_symbols(light: FloatArray, scene: Scene) -> DecodeResult:
    """Read the bits of a packet of colours.

    Parameters
    ----------
    light : ndarray of float64, shape (3, columns)
        The light of the red, green and blue LED in each column.
    """
    order = scene.colours.colour_light
    sent = scene.transmitter.payload_bits
    length = HEADER + len(symbols_of(order, sent))
    total = light.sum(axis=0)
    shape = np.array([0.0] * HEADER + [1.0] * (length - HEADER))
    starts = np.arange(length * _STARTS) / _STARTS
    models = np.array(
        [symbol_fractions(scene, length, total.size, start) @ shape for start in starts]
    )
    fits = [_correlation(total, model) for model in models]
    best = int(np.argmax(fits))
    result = DecodeResult("csk", signal=total, correlation=fits[best])
    if fits[best] < _LEAST_CORRELATION:
        return replace(result, failure="No header: the sum of the colours shows no dark symbols.")
    table = symbol_fractions(scene, length, total.size, float(starts[best]))
    if len(total) < length or np.linalg.cond(table) > _WORST_CONDITION:
        return replace(
            result, failure="The exposure or the columns leave the light of single symbols unknown."
        )
    powers = np.linalg.lstsq(table, light.T, rcond=None)[0]
    dark = powers[:HEADER].mean(axis=0)
    powers = powers[HEADER:] - dark
    powers /= max(float(np.median(powers.sum(axis=1))), 1e-9)
    points = np.array(POINTS[order]) / PARTS
    distances = np.linalg.norm(powers[:, None] - points[None], axis=2)
    bits = bits_of(order, np.argmin(distances, axis=1).tolist(), len(sent))
    payload = scene.transmitter.payload
    return replace(
        result,
        code=code_of(bits),
        bits=np.array(bits, dtype=np.uint8),
        payload=payload_of_bits(bits, form_of(payload)) if payload else "",
        chip_length=1.0 / (scene.transmitter.switching_frequency * scene.camera.readout_time),
    )


def symbol_fractions(scene: Scene, length: int, columns: int, start: float) -> FloatArray:
    """Return the fraction of each column's exposure during each symbol of a packet.

    ``start`` is the symbol, with a fraction, during which the first column's exposure starts. Shape
    (columns, length); each row sums to 1.
    """
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    exposure = camera.exposure_time * frequency
    begin = start + np.arange(columns) * (camera.readout_time * frequency)
    symbols = np.arange(math.ceil(exposure) + 1)
    first = np.floor(begin).astype(np.int64)
    edges = np.maximum(first[:, None] + symbols, begin[:, None])
    ends = np.minimum(first[:, None] + symbols + 1.0, (begin + exposure)[:, None])
    overlap = np.maximum(ends - edges, 0.0) / exposure
    table = np.zeros((columns, length))
    rows = np.broadcast_to(np.arange(columns)[:, None], overlap.shape)
    np.add.at(table, (rows, (first[:, None] + symbols) % length), overlap)
    return table


def _correlation(seen: FloatArray, model: FloatArray) -> float:
    seen, model = seen - seen.mean(), model - model.mean()
    size = float(np.linalg.norm(seen) * np.linalg.norm(model))
    return float(seen @ model) / size if size > 1e-12 else 0.0
