"""Measure bit error rates over exposure and noise.

The model is minimal: rows integrate the chips over their exposure and have independent noise. The
settings are those of the published benchmark of rolling-shutter equalizers: exposures of one to
seven symbols, four to seven rows per symbol, Manchester code (C. Jurado-Verdu et al., Opt. Express
29:22973, 2021). A symbol is a chip.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import lit_fraction
from occ_model.errors import ParameterError, quote
from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decode import decode, decoder_named, decoders
from occ_model.results.bit_errors import (
    BenchBounds,
    BenchPlace,
    BenchPoint,
    BenchRequest,
    BitErrors,
)
from occ_model.scene.argument_checks import check_count, check_seed
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.scene.scene import Scene
from occ_model.study.bit_error_rate import MOST_BITS, bit_errors_of, with_payload
from occ_model.study.theory import gaussian_rate_bound
from occ_model.transmitter.scheme import scheme_of

_DARK, _SWING = 40.0, 160.0  # grey levels: lamp off, and its swing; leaves room for noise of 10 dB
_ROWS_A_SYMBOL = (1.0, 100.0)
_LONGEST_EXPOSURE = 100.0
_MAX_DECIBELS = 100.0


def bench(
    request: BenchRequest, progress: Callable[[int, int], object] = lambda _done, _all: None
) -> tuple[BenchPoint, ...]:
    check_bench(request)
    points: list[BenchPoint] = []
    for number, place in enumerate(request.points):
        progress(number, len(request.points))
        points += measure_bench_point(request, place)
    progress(len(request.points), len(request.points))
    return tuple(points)


def measure_bench_point(
    request: BenchRequest, place: BenchPlace, heartbeat: Heartbeat = lambda: None
) -> tuple[BenchPoint, ...]:
    """Measure one point of a checked request, independent of the others, for each decoder."""
    scheme, _, exposure, ratio = place
    scene = bench_scene(request, scheme, exposure)
    names = request.decoders or decoders()
    length, duration = request.payload_bits, _period(scene)
    wrong_bits: dict[str, list[int]] = {name: [] for name in names}
    right_pictures = dict.fromkeys(names, 0)
    notes = dict.fromkeys(names, "")
    faults = {name: Faults() for name in names}
    random = np.random.default_rng(request.seed)
    for _ in range(-(-request.bits // length)):
        heartbeat()
        bits = random.integers(0, 2, length)
        start = float(random.uniform(0.0, duration))
        sent_scene = with_payload(scene, bits.tolist()).replace(start_time=start)
        signal = bench_signal(sent_scene, ratio, random)
        for name in names:
            with faults[name].counting():
                read = decode(signal, sent_scene, name)
            # The rate includes rejected bits, since theory decides every bit, but the payload does
            # not count as read.
            has_all_bits = read.bits.size == length
            wrong_bits[name].append(int((read.bits != bits).sum()) if has_all_bits else length)
            right_pictures[name] += read.failure is None and not wrong_bits[name][-1]
            notes[name] = notes[name] or read.failure or ""
    return tuple(
        BenchPoint(
            *place,
            _bit_errors(scene, name, wrong_bits[name], right_pictures[name], fault),
            fault or note,
        )
        for (name, note), fault in zip(notes.items(), map(str, faults.values()), strict=True)
    )


def _bit_errors(scene: Scene, decoder: str, wrong: list[int], right: int, faults: str) -> BitErrors:
    errors = bit_errors_of(scene, decoder, wrong, right)
    # Every row sees the light.
    return replace(errors, picture_time=errors.readout_time, faults=faults)


def check_bench(request: BenchRequest) -> None:
    for name in request.decoders:
        decoder_named(name)
    check_count("bits", request.bits, 1, MOST_BITS)
    check_seed(request.seed)
    _check_range("rows a symbol", request.rows_a_symbol, *_ROWS_A_SYMBOL)
    for exposure in (*request.exposures, request.at_exposure):
        _check_range("exposure in symbols", exposure, 1e-3, _LONGEST_EXPOSURE)
    for ratio in (*request.decibels, request.at_decibels):
        _check_range("signal-to-noise ratio in dB", ratio, -_MAX_DECIBELS, _MAX_DECIBELS)
    for scheme in request.schemes:
        scene = bench_scene(request, scheme)
        _ = scheme_of(scene.transmitter).length  # raises if its parts are incompatible


def bench_scene(request: BenchRequest, scheme: str, exposure: float = 1.0) -> Scene:
    """Return the scene of a point, with rows as its columns; ``exposure`` in symbols."""
    line_code, _, framing = scheme.partition("/")
    symbol = request.rows_a_symbol * request.readout_time
    check_count("payload_bits", request.payload_bits, 1, MAX_PAYLOAD_BITS)
    return Scene().replace(
        columns=request.rows,
        readout_time=request.readout_time,
        line_code=line_code,
        framing=framing or "preamble",
        preamble=request.preamble,
        error_correction=request.error_correction,
        payload="bits:" + "0" * request.payload_bits,
        switching_frequency=1.0 / symbol,
        exposure_time=exposure * symbol,
        enhancement="none",
        averaging="pixel-value",
    )


def bench_signal(scene: Scene, decibels: float, random: np.random.Generator) -> FloatArray:
    """Return the grey levels of the rows with noise, shape (columns,)."""
    deviation = _SWING * math.sqrt(0.25 / 10.0 ** (decibels / 10.0))
    lit = lit_fraction(scene)
    return _DARK + _SWING * lit + deviation * random.standard_normal(len(lit))


def _period(scene: Scene) -> float:
    return scheme_of(scene.transmitter).length * scene.transmitter.switching_period


def _check_range(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise ParameterError.of(name, quote(value), f"{low:g} to {high:g}")


_CURVE_POINTS = 31

_NULL_EXPOSURE = 2.0  # first null of alternating chips in symbols; the others are multiples


def bench_bounds(request: BenchRequest, heartbeat: Heartbeat = lambda: None) -> BenchBounds:
    """Compute the theoretical bounds along both axes of a request.

    The nulls are those of alternating chips, the fastest wave of each line code. Its frequency is
    f/2, and |sinc(t f / 2)| vanishes if the exposure lasts an even number of symbols. The bound of
    the bits is :func:`occ_model.study.theory.gaussian_rate_bound`, which does not depend on the
    scheme.
    """

    def bound(exposure: float, decibels: float) -> float:
        heartbeat()
        scene = bench_scene(request, request.schemes[0], exposure)
        return gaussian_rate_bound(scene, 10.0 ** (decibels / 10.0), frames_a_second=1.0)

    exposures, ratios = _sample_range(request.exposures), _sample_range(request.decibels)
    longest = max(request.exposures, default=0.0)
    return BenchBounds(
        tuple(_NULL_EXPOSURE * number for number in range(1, int(longest / _NULL_EXPOSURE) + 1)),
        {
            "exposure": (exposures, tuple(bound(each, request.at_decibels) for each in exposures)),
            "noise": (ratios, tuple(bound(request.at_exposure, each) for each in ratios)),
        },
    )


def _sample_range(values: tuple[float, ...]) -> tuple[float, ...]:
    """Return equally spaced values from the smallest to the largest of some values."""
    if not values:
        return ()
    return tuple(np.linspace(min(values), max(values), _CURVE_POINTS).tolist())
