"""Measure bit error rates over exposure and noise: any scheme, any decoder, one closed setting.

Rows see the chips through their exposure, and have independent noise; nothing else happens. The
settings are those of the published benchmark of rolling-shutter equalizers: exposures of one to
seven symbols, four to seven rows a symbol, Manchester (C. Jurado-Verdu et al., Opt. Express
29:22973, 2021). A symbol is a chip.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import lit_fraction
from occ_model.errors import ParameterError, shown
from occ_model.receiver.decode import decode
from occ_model.receiver.decoders import decoder_named, decoders
from occ_model.results import BitErrors
from occ_model.scene.argument_checks import check_count, check_seed
from occ_model.scene.scene import Scene
from occ_model.study.bit_error_rate import MOST_BITS, bit_errors_of, with_payload
from occ_model.transmitter.scheme import scheme_of

EXPOSURES = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)
"""Exposures in symbols."""

DECIBELS = (10.0, 15.0, 20.0, 25.0, 30.0)
"""Signal-to-noise ratios: the chips' variance over that of a row's noise."""

_DARK, _SWING = 40.0, 160.0
"""Grey levels without and with the lamp lit; noise of 10 dB stays within 0 to 255."""

_ROWS_A_SYMBOL = (1.0, 100.0)
_LONGEST_EXPOSURE = 100.0
_MOST_DECIBELS = 100.0


@dataclass(frozen=True, slots=True)
class BenchRequest:
    """What the bench measures.

    Parameters
    ----------
    schemes
        Each the name of a line code, or of a line code and a framing with a slash between.
    decoders
        The decoders' names.
    exposures, decibels
        The exposures in symbols, at the largest of which ratios no other one is tried; and the
        signal-to-noise ratios, tried at ``at_exposure``.
    at_exposure, at_decibels
        The exposure of the curve over noise, and the ratio of the curve over exposure.
    rows_a_symbol
        Rows that are read out while a symbol lasts.
    payload_bits
        Bits of a payload; each picture shows another one.
    bits
        Bits at each point at the least.
    seed
        Seed of payloads, start times and noise.
    """

    schemes: tuple[str, ...] = ("manchester",)
    decoders: tuple[str, ...] = ()
    exposures: tuple[float, ...] = EXPOSURES
    decibels: tuple[float, ...] = DECIBELS
    at_exposure: float = 4.0
    at_decibels: float = 30.0
    rows_a_symbol: float = 5.0
    payload_bits: int = 256
    bits: int = 10_240
    seed: int = 1

    @property
    def points(self) -> tuple[tuple[str, str, float, float], ...]:
        """The points: the scheme, what is varied, the exposure and the ratio of each."""
        return tuple(
            (scheme, axis, exposure, ratio)
            for scheme in self.schemes
            for axis, exposure, ratio in (
                *(("exposure", exposure, self.at_decibels) for exposure in self.exposures),
                *(("noise", self.at_exposure, ratio) for ratio in self.decibels),
            )
        )


@dataclass(frozen=True, slots=True)
class BenchPoint:
    """Bit errors of a decoder at one exposure and one noise.

    Parameters
    ----------
    scheme
        As in the request.
    axis
        ``"exposure"`` or ``"noise"``: what is varied.
    exposure, decibels
        The exposure in symbols and the signal-to-noise ratio.
    errors
        The bit errors.
    note
        Why the first payload was not read that was not; empty where all were.
    """

    scheme: str
    axis: str
    exposure: float
    decibels: float
    errors: BitErrors
    note: str = ""


def bench(
    request: BenchRequest, progress: Callable[[int, int], object] = lambda _done, _all: None
) -> tuple[BenchPoint, ...]:
    """Measure all points of a request.

    Parameters
    ----------
    request
        What to measure.
    progress
        Called with the number of points that are done, and of all of them.

    Returns
    -------
    tuple of BenchPoint
        A point for each decoder at each point of the request.

    Raises
    ------
    ParameterError
        A value is not allowed, or there is no such line code, framing or decoder.
    """
    check_bench(request)
    found: list[BenchPoint] = []
    for done, (scheme, axis, exposure, ratio) in enumerate(request.points):
        progress(done, len(request.points))
        scene = bench_scene(scheme, request.payload_bits, exposure, request.rows_a_symbol)
        found += _measured(scene, request, (scheme, axis, exposure, ratio))
    progress(len(request.points), len(request.points))
    return tuple(found)


def check_bench(request: BenchRequest) -> None:
    """Check a request; errors as :func:`bench`."""
    for name in request.decoders:
        decoder_named(name)
    check_count("bits", request.bits, 1, MOST_BITS)
    check_seed(request.seed)
    _check("rows a symbol", request.rows_a_symbol, *_ROWS_A_SYMBOL)
    for exposure in (*request.exposures, request.at_exposure):
        _check("exposure in symbols", exposure, 1e-3, _LONGEST_EXPOSURE)
    for ratio in (*request.decibels, request.at_decibels):
        _check("signal-to-noise ratio in dB", ratio, -_MOST_DECIBELS, _MOST_DECIBELS)
    for scheme in request.schemes:
        scene = bench_scene(scheme, request.payload_bits, 1.0, request.rows_a_symbol)
        _ = scheme_of(scene.transmitter).length  # refused where its parts do not go together


def bench_scene(scheme: str, payload_bits: int, exposure: float, rows_a_symbol: float) -> Scene:
    """Return the scene of a point: the default camera, whose rows are the columns of its picture.

    Raises
    ------
    ParameterError
        There is no such line code or framing, or a value is out of range.
    """
    line_code, _, framing = scheme.partition("/")
    scene = Scene()
    symbol = rows_a_symbol * scene.camera.readout_time
    check_count("payload_bits", payload_bits, 1, 4096)
    return scene.replace(
        line_code=line_code,
        framing=framing or "preamble",
        payload="bits:" + "0" * payload_bits,
        switching_frequency=1.0 / symbol,
        exposure_time=exposure * symbol,
        enhancement="none",
        averaging="pixel-value",
    )


def bench_signal(scene: Scene, decibels: float, random: np.random.Generator) -> FloatArray:
    """Return the grey levels of the rows, with their noise, shape (columns,)."""
    deviation = _SWING * math.sqrt(0.25 / 10.0 ** (decibels / 10.0))
    lit = lit_fraction(scene)
    return _DARK + _SWING * lit + deviation * random.standard_normal(len(lit))


def _measured(
    scene: Scene, request: BenchRequest, point: tuple[str, str, float, float]
) -> Iterator[BenchPoint]:
    names = request.decoders or decoders()
    length, duration = request.payload_bits, _period(scene)
    wrong: dict[str, list[int]] = {name: [] for name in names}
    notes = dict.fromkeys(names, "")
    random = np.random.default_rng(request.seed)
    for _ in range(-(-request.bits // length)):
        bits = random.integers(0, 2, length)
        start = float(random.uniform(0.0, duration))
        sent = with_payload(scene, bits.tolist()).replace(start_time=start)
        signal = bench_signal(sent, point[3], random)
        for name in names:
            read = decode(signal, sent, name)
            is_whole = read.bits.size == length
            wrong[name].append(int((read.bits != bits).sum()) if is_whole else length)
            notes[name] = notes[name] or read.failure or ""
    for name in names:
        yield BenchPoint(*point, bit_errors_of(scene, name, wrong[name]), notes[name])


def _period(scene: Scene) -> float:
    return scheme_of(scene.transmitter).length * scene.transmitter.switching_period


def _check(what: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise ParameterError(f"The {what} is {shown(value)}; allowed: {low:g} to {high:g}.")


def written(points: Sequence[BenchPoint]) -> list[tuple[object, ...]]:
    """Return the rows of the table under :data:`HEADER`."""
    return [
        (
            point.scheme,
            point.errors.decoder,
            point.axis,
            point.exposure,
            point.decibels,
            point.errors.bits,
            point.errors.errors,
            point.errors.rate,
            point.errors.low,
            point.errors.high,
            point.errors.pictures_right,
            point.errors.pictures,
            point.note,
        )
        for point in points
    ]


HEADER = (
    "scheme", "decoder", "varied", "exposure (symbols)", "signal to noise (dB)", "bits",
    "wrong bits", "bit error rate", "low", "high", "payloads right", "payloads", "note",
)  # fmt: skip
"""The columns of the table."""
