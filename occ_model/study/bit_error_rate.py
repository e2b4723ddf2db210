"""Measure the bit error rate with random payloads, each in a picture of its own."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from occ_model.errors import ParameterError, quote
from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.results.bit_errors import BitErrors
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.frame import Plan
from occ_model.results.sweep_request import RateSettings, SignalPath
from occ_model.scene.argument_checks import check_count
from occ_model.scene.scene import TOLERANCE, Scene
from occ_model.study.confidence import wilson_interval
from occ_model.study.success_rate import check_rate, plan_images, right_bits_of_scenes
from occ_model.study.theory import panel_readout_time
from occ_model.transmitter.scheme import code_of, sent_chips

MOST_BITS = 100_000_000  # maximum number of bits of a measurement
_PLANNED_PAYLOADS = 3  # payloads whose plans decide which effects are simulated for all


def bit_error_rate(  # noqa: PLR0913 - a study's settings, most of them optional
    scene: Scene,
    decoder: str = PAPER_DECODER,
    bits: int = 10_000,
    seed: int = 1,
    *,
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    path: SignalPath = "auto",
    heartbeat: Heartbeat = lambda: None,
) -> BitErrors:
    """Measure the fraction of bits that a decoder reads wrongly.

    Each random payload, of the scene's length, has its own picture with a random start time and
    noise. All bits of an unread or rejected payload count as wrong, as in
    :func:`occ_model.success_rate`, whose complement this is.

    Parameters
    ----------
    scene
        The scene; its code or payload and its start time are not used.
    decoder
        The decoder's name.
    bits
        Minimum number of bits; only whole payloads are sent.
    seed
        Seed of the payloads, the start times and the noise.
    tolerance, force, path
        As for :func:`occ_model.success_rate`.
    heartbeat
        Called for each picture; an exception from it ends the measurement.

    Raises
    ------
    ParameterError
        An argument is not allowed, or the scene sends a raw pattern or no code.
    ProjectionError
        The scene has no picture.
    """
    check_count("bits", bits, 1, MOST_BITS)
    settings = RateSettings(1, (decoder,), seed, tolerance, force or {}, path)
    check_rate(scene, settings)
    length = scene.transmitter.payload_length
    random = np.random.default_rng(seed)
    shared_plan = _shared_plan(scene, settings, random)
    pictures = random_pictures(scene, -(-bits // length), random)
    with Faults().counting() as faults:
        right_bits = right_bits_of_scenes(pictures, settings, heartbeat, shared_plan)
        wrong_bits = [length - right for (right,) in right_bits]
    return replace(
        bit_errors_of(scene, decoder, wrong_bits, wrong_bits.count(0)), faults=str(faults)
    )


def _shared_plan(scene: Scene, settings: RateSettings, random: np.random.Generator) -> Plan | None:
    """Return a plan for all pictures; None if each picture needs its own."""
    transmitter = scene.transmitter
    packet = len(sent_chips(transmitter)) * transmitter.switching_period
    if settings.path == "image" and panel_readout_time(scene) < packet:
        return None
    (payload_random,) = random.spawn(1)
    size = _PLANNED_PAYLOADS, transmitter.payload_length
    payloads = payload_random.integers(0, 2, size).tolist()
    return plan_images([with_payload(scene, bits) for bits in payloads], settings)


def random_pictures(
    scene: Scene, count: int, random: np.random.Generator
) -> Iterator[tuple[Scene, int]]:
    """Yield the scene with random payloads of its length, each with the seed of its picture."""
    for _ in range(count):
        bits = random.integers(0, 2, scene.transmitter.payload_length)
        yield with_payload(scene, bits.tolist()), int(random.integers(2**32))


def with_payload(scene: Scene, bits: Sequence[int]) -> Scene:
    """Return the scene sending these bits, as a code if it sends a code."""
    if scene.transmitter.payload:
        return scene.replace(payload="bits:" + "".join(map(str, bits)))
    return scene.replace(code=code_of(bits))


def bit_errors_of(scene: Scene, decoder: str, wrong_bits: Sequence[int], right: int) -> BitErrors:
    """Return the result from the wrong bits of each picture and the number of correct pictures."""
    length, camera = scene.transmitter.payload_length, scene.camera
    low, high = error_interval(wrong_bits, length)
    right_low, right_high = wilson_interval(right, len(wrong_bits))
    return BitErrors(
        decoder=decoder,
        bits=length * len(wrong_bits),
        errors=sum(wrong_bits),
        low=low,
        high=high,
        pictures=len(wrong_bits),
        pictures_right=right,
        right_low=right_low,
        right_high=right_high,
        picture_time=panel_readout_time(scene),
        readout_time=camera.columns * camera.readout_time,
    )


def error_interval(wrong_bits: Sequence[int], length: int) -> tuple[float, float]:
    """Return the 95 % interval of a bit error rate if the bits of a picture fail together.

    This is Wilson's interval for the effective number of independent bits, bits / D, with the
    design effect D = s^2 / (p (1 - p) / length) and s^2 the variance of the pictures' own rates (L.
    Kish, Survey Sampling, 1965). If all bits or none are wrong, D is unknown and each picture
    counts as one bit.
    """
    pictures, errors = len(wrong_bits), sum(wrong_bits)
    rate = errors / (pictures * length)
    design_effect = float(length)
    if 0.0 < rate < 1.0 and pictures > 1:
        scatter = float(np.var(np.array(wrong_bits) / length, ddof=1))
        design_effect = min(max(scatter / (rate * (1.0 - rate) / length), 1.0), float(length))
    bits = max(1, math.floor(pictures * length / design_effect))
    return _interval(rate, bits)


def _interval(rate: float, bits: int) -> tuple[float, float]:
    """Return Wilson's interval of a rate of this many bits, errors rounded outwards."""
    low, _ = wilson_interval(math.floor(rate * bits), bits)
    _, high = wilson_interval(math.ceil(rate * bits), bits)
    return low, high


def check_frame_rate(scene: Scene, frames_a_second: float) -> None:
    """Refuse an invalid frame rate, or one that leaves too little time to read out a picture."""
    most = 1.0 / (scene.camera.columns * scene.camera.readout_time)
    is_number = isinstance(frames_a_second, int | float) and not isinstance(frames_a_second, bool)
    if not is_number or not 0.0 < frames_a_second <= most:
        raise ParameterError.of(
            "frames_a_second",
            quote(frames_a_second),
            f"above 0 to {most:.4g}, where the readout of {scene.camera.columns} columns fills the "
            "time of a picture",
        )
