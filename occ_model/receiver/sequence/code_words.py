"""Find the words of any scheme by encoding: the chips that its line code and framing can send.

Every block is encoded after each state of the line code; states differ in the chips that follow.
The common start of all frames is an additional word.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.receiver.sequence.trellis import (
    FREE_CHIPS,
    Word,
    count_paths,
    steps_from_places,
)
from occ_model.scene.scene import Transmitter
from occ_model.transmitter.line_codes.line_code import LineCode
from occ_model.transmitter.scheme import Scheme, scheme_named, scheme_of

MOST_STATES = 2048  # maximum for a complete search of a trellis
_MAX_ENCODER_STATES = 16  # above this an encoder's words are not listed
_MAX_BLOCK = 8  # bits of a block above which its words are not listed

_MAX_SAMPLED_BITS = 64  # payload bits up to which words are checked with all sample payloads
_SAMPLES = 8  # number of random payloads, besides one of zeros and one of ones


@dataclass(frozen=True, slots=True)
class CodeWords:
    words: tuple[Word, ...]
    # The chips at the start of every frame; empty if unknown
    header: tuple[int, ...] = ()


def find_code_words(transmitter: Transmitter, memory: int) -> CodeWords:
    """Return the words that a transmitter can send, for a trellis of ``memory`` chips.

    If the trellis of the code has too many states, words that only limit the run length take its
    place. If their trellis is also too large, the code's words are returned for a beam search.
    """
    if transmitter.pattern:
        return CodeWords(FREE_CHIPS)
    code_words = _words_of_scheme(
        transmitter.line_code,
        transmitter.framing,
        transmitter.preamble,
        transmitter.error_correction,
        scheme_of(transmitter).bits,
    )
    if count_paths(code_words.words, memory) <= MOST_STATES:
        return code_words
    run_words = CodeWords(words_of_runs(_longest_run(code_words.words)), code_words.header)
    return run_words if count_paths(run_words.words, memory) <= MOST_STATES else code_words


@lru_cache(maxsize=32)
def _words_of_scheme(
    line_code: str, framing: str, preamble: str, correction: str, bits: int
) -> CodeWords:
    scheme = scheme_named(line_code, framing, preamble, correction, bits)
    periods = _sample_periods(scheme)
    blocks = _list_blocks(scheme.line_code)
    states = range(1 + max(word.start_state for word in blocks))
    common_start = periods[0][: _common_prefix(periods)]
    for length in range(len(common_start), -1, -1):
        header = tuple(common_start[:length].tolist())
        state_pairs = product(states, states) if header else ()
        words = (
            *blocks,
            *(Word(start_state, header, end_state) for start_state, end_state in state_pairs),
        )
        # The number of bits is part of some headers, so samples are as long as the payload.
        samples = periods if bits <= _MAX_SAMPLED_BITS else periods[-2:]
        if all(_accepts(words, period) for period in samples):
            return CodeWords(words, header)
    return CodeWords(FREE_CHIPS)


def _sample_periods(scheme: Scheme) -> list[ByteArray]:
    random = np.random.default_rng(1)
    payloads = random.integers(0, 2, (_SAMPLES, scheme.bits), dtype=np.uint8)
    constant = np.array([[0], [1]], dtype=np.uint8).repeat(scheme.bits, axis=1)
    return [scheme.encode(payload) for payload in np.concatenate([payloads, constant])]


def _common_prefix(periods: list[ByteArray]) -> int:
    same = np.all(np.array(periods) == periods[0], axis=0)
    return len(same) if same.all() else int(same.argmin())


def _list_blocks(line_code: LineCode) -> tuple[Word, ...]:
    """Return the words of a line code between the states of its encoder."""
    if line_code.block_bits > _MAX_BLOCK:
        return FREE_CHIPS
    blocks = [
        np.array(bits, dtype=np.uint8) for bits in product((0, 1), repeat=line_code.block_bits)
    ]
    state_numbers: dict[bytes, int] = {}
    states: list[tuple[ByteArray, int]] = []

    def state_after(bits: ByteArray, level: int) -> int:
        key = _chips_after(line_code, bits, level, (blocks[0], blocks[-1], blocks[1]))
        if key not in state_numbers:
            state_numbers[key] = len(states)
            states.append((bits, level))
        return state_numbers[key]

    for level in (0, 1):
        state_after(np.empty(0, dtype=np.uint8), level)
    words = []
    for state, (bits, level) in enumerate(states):  # the list grows meanwhile
        if len(states) > _MAX_ENCODER_STATES:
            return FREE_CHIPS
        for block in blocks:
            sent_bits = np.concatenate([bits, block])
            chips = line_code.encode(sent_bits, level)[-line_code.block_chips :]
            words.append(Word(state, tuple(chips.tolist()), state_after(sent_bits, level)))
    return tuple(words)


def _chips_after(
    line_code: LineCode, bits: ByteArray, level: int, probes: Iterable[ByteArray]
) -> bytes:
    """Return the chips of some blocks after a number of bits, which identify the state."""
    start = len(bits) // line_code.block_bits * line_code.block_chips
    probe_chips = [
        line_code.encode(np.concatenate([bits, probe]), level)[start:] for probe in probes
    ]
    return np.concatenate(probe_chips).tobytes()


def _accepts(words: tuple[Word, ...], period: ByteArray) -> bool:
    """Return whether a period, sent repeatedly, is a sequence of words."""
    steps = steps_from_places(words)
    positions = set(range(len(steps)))
    for chip in np.concatenate([period, period, period]).tolist():
        positions = {
            to for position in positions for step_chip, to in steps[position] if step_chip == chip
        }
        if not positions:
            return False
    return True


def _longest_run(words: tuple[Word, ...]) -> int | None:
    """Return the maximum number of equal chips in a row that the words allow; None if unlimited."""
    steps = steps_from_places(words)
    longest = 0
    for value in (0, 1):
        positions, run = set(range(len(steps))), 0
        while positions:
            positions = {
                to for position in positions for chip, to in steps[position] if chip == value
            }
            run += bool(positions)
            if run > len(steps):
                return None
        longest = max(longest, run)
    return longest


@lru_cache(maxsize=16)
def words_of_runs(longest: int | None) -> tuple[Word, ...]:
    """Return the words of all sequences whose runs have at most ``longest`` chips."""
    if longest is None:
        return FREE_CHIPS
    words = []
    for value, run in product((0, 1), range(longest)):
        state = value * longest + run
        words.append(Word(state, (1 - value,), (1 - value) * longest))
        if run + 1 < longest:
            words.append(Word(state, (value,), state + 1))
    return tuple(words)
