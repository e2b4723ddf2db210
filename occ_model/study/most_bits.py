"""Search for the line code, switching frequency and payload that carry most bits a second.

A picture shows a certain number of the panel's chips. For each line code and frequency, payloads
are tried that fill all of them, a half or a quarter, because repetitions compensate for noise. The
combinations are tried in falling order of the bits that they would carry, so the first one that is
read is the best.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decode import decoder_named
from occ_model.results.bit_errors import FRAMES_A_SECOND, MostBits
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.argument_checks import check_count, check_seed
from occ_model.scene.parameters import quantity
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.bit_error_rate import check_frame_rate, random_pictures, with_payload
from occ_model.study.cause.cause import cause_of
from occ_model.study.success_rate import right_bits_of_scenes
from occ_model.study.theory import is_panel_in_picture, panel_readout_time
from occ_model.transmitter.registry import LINE_CODES
from occ_model.transmitter.scheme import check_code, scheme_of

# Only the best known of the line codes with the same rate
_TRIED_LINE_CODES = ("manchester", "4b6b", "8b10b")
DECODERS = ("threshold", "equalizer", "sequence")  # for payloads of any length, fastest first

VARIED_PARAMETERS = (  # chosen by the search, whose result depends on all the others
    "pattern", "line_code", "framing", "preamble", "error_correction", "payload",
    "switching_frequency",
)  # fmt: skip

_FRAMING = "preamble"

_FREQUENCY_RATIO = 1.15  # ratio of neighbouring frequencies
_FILLED_FRACTIONS = (0.95, 0.5, 0.25)  # period of a payload over the chips of a picture


@dataclass(frozen=True, slots=True)
class Candidate:
    line_code: str
    frequency: float
    bits: int


def most_bits(
    scene: Scene,
    decoders: Sequence[str],
    *,
    frames_a_second: float = FRAMES_A_SECOND,
    pictures: int = 10,
    seed: int = 1,
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[str, int, int], object] = lambda _decoder, _done, _all: None,
) -> tuple[MostBits, ...]:
    """Find the combination that carries most bits at a scene's exposure time and distance.

    Parameters
    ----------
    scene
        The scene; its scheme, payload and switching frequency are varied.
    frames_a_second
        Pictures a second, each of which shows another payload.
    pictures
        Number of pictures of which all bits must be read.
    seed
        Seed of payloads, start times and noise.
    heartbeat
        Called for each picture; an exception from it ends the search.
    progress
        Called with a decoder, the number of combinations tried with it, and their total number.

    Returns
    -------
    tuple of MostBits
        One result for each decoder.

    Raises
    ------
    ParameterError
        An argument is not allowed, or another light than a code is sent.
    ProjectionError
        The scene has no picture.
    """
    check_code(scene.transmitter)
    check_count("pictures", pictures, 1, 10_000)
    check_seed(seed)
    check_frame_rate(scene, frames_a_second)
    for name in decoders:
        decoder_named(name)
    candidates = list_candidates(scene)
    results = []
    for name in decoders:
        settings = RateSettings(1, (name,), seed)
        with Faults().counting() as faults:
            index, best_scene = _find_first_readable(
                scene, candidates, settings, pictures, (heartbeat, progress)
            )
        bits = 0 if best_scene is None else candidates[index].bits
        failure = None if best_scene is not None else _explain_failure(scene, candidates, settings)
        results.append(
            MostBits(
                name, best_scene, pictures, bits * frames_a_second, frames_a_second, index, failure,
                str(faults),
            )
        )  # fmt: skip
    return tuple(results)


def reset_varied(scene: Scene) -> Scene:
    """Return a scene with the parameters reset that do not affect the result of the search."""
    frequency = quantity("switching_frequency").default
    return _send_zeros(scene, _TRIED_LINE_CODES[0], 1, frequency).replace(code=0, start_time=0.0)


def make_example(result: MostBits, seed: int = 1) -> Scene | None:
    """Return the scene that carries most bits, with a random payload of the length tried."""
    if result.scene is None:
        return None
    length = result.scene.transmitter.payload_length
    bits = np.random.default_rng(seed).integers(0, 2, length)
    return with_payload(result.scene, bits.tolist())


def _explain_failure(scene: Scene, candidates: Sequence[Candidate], settings: RateSettings) -> str:
    if not panel_readout_time(scene) and not is_panel_in_picture(scene):
        return "No column of the picture shows the panel."
    if not candidates:
        return "The picture shows too few chips of the panel for any payload; come closer."
    shortest = candidates[-1]  # the one that is read most easily
    (decoder,) = settings.decoders
    cause = cause_of(
        _send_zeros(scene, shortest.line_code, shortest.bits, shortest.frequency),
        decoder,
        SimulationSettings(seed=settings.seed),
    )
    failure = f"None of {len(candidates)} combinations of line code, frequency and bits was read."
    return f"{cause} {failure}" if cause is not None and cause.is_overexposed else failure


def list_candidates(scene: Scene) -> list[Candidate]:
    """Return the combinations to try, most bits first, and among equals the lowest frequency."""
    readout = panel_readout_time(scene)  # seconds
    candidates = {
        Candidate(line_code, frequency, bits)
        for line_code in _TRIED_LINE_CODES
        for frequency in _frequencies(scene)
        for fraction in _FILLED_FRACTIONS
        if (bits := _count_bits(line_code, fraction * readout * frequency)) > 0
    }
    return sorted(
        candidates,
        key=lambda candidate: (-candidate.bits, candidate.frequency, candidate.line_code),
    )


def _frequencies(scene: Scene) -> list[float]:
    """Return switching frequencies up to that of one chip per column."""
    low = quantity("switching_frequency").slider[0]
    high = 1.0 / scene.camera.readout_time
    count = max(1, int(np.log(high / low) / np.log(_FREQUENCY_RATIO)))
    return [low * _FREQUENCY_RATIO**step for step in range(count + 1)]


def _count_bits(line_code: str, chips: float) -> int:
    """Return the number of bits of the longest payload that fits in a number of chips."""
    code = LINE_CODES.get(line_code)
    overhead = scheme_of(_send_zeros(Scene(), line_code, 1, 1e3).transmitter).length
    blocks = int((chips - overhead) // code.block_chips)
    return min(MAX_PAYLOAD_BITS, max(0, blocks) * code.block_bits)


def _send_zeros(scene: Scene, line_code: str, bits: int, frequency: float) -> Scene:
    return scene.replace(
        pattern="", line_code=line_code, framing=_FRAMING, preamble="", error_correction="none",
        payload="bits:" + "0" * bits, switching_frequency=frequency,
    )  # fmt: skip


def _find_first_readable(
    scene: Scene,
    candidates: Sequence[Candidate],
    settings: RateSettings,
    pictures: int,
    calls: tuple[Heartbeat, Callable[[str, int, int], object]],
) -> tuple[int, Scene | None]:
    """Return the index of the first candidate whose pictures are all read, and its scene."""
    heartbeat, progress = calls
    (decoder,) = settings.decoders
    for index, candidate in enumerate(candidates):
        progress(decoder, index, len(candidates))
        sending = _send_zeros(scene, candidate.line_code, candidate.bits, candidate.frequency)
        sent = random_pictures(sending, pictures, np.random.default_rng(settings.seed))
        right_bits = right_bits_of_scenes(sent, settings, heartbeat)
        if all(right == candidate.bits for (right,) in right_bits):
            return index, sending
    return len(candidates), None
