"""Verdict on a decoder's result: the code read, compared with the one sent, in words."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from occ_gui.simulation.snapshot import ColumnView, Reading
from occ_gui.widgets.state_look import State
from occ_model.errors import capitalize, one_line
from occ_model.results.bands import NO_BARS_DEPTH, ROUNDING_DEPTH, depth_text, format_depth
from occ_model.results.decoding import Cause, DecodeResult, symptom
from occ_model.scene.light_words import describe_light

_LONGEST_PAYLOAD = 24  # characters of a payload that a title shows

_WAITING = "This decoder takes longer: it reads the picture now."

_CLAUSE_END = re.compile(r"[:;,.](?= |$)")


@dataclass(frozen=True, slots=True)
class CodeVerdict:
    # Good if all bits are right, doubtful if some are, bad if none is or no code was read, neutral
    # if none is sent, waiting while a slow decoder reads
    state: State
    title: str
    reason: str = ""  # the decoder's sentence on why no code was read, otherwise empty

    @property
    def explanation(self) -> str:
        """The rest of the reason, after the heading; may be empty."""
        parts = _CLAUSE_END.split(self.reason, maxsplit=1)
        if self.state is not State.BAD or len(parts) < 2:
            return self.reason
        return capitalize(parts[1].strip())

    @property
    def heading(self) -> str:
        if not self.reason or self.state is not State.BAD:
            return self.title
        cause = _CLAUSE_END.split(self.reason, maxsplit=1)[0]
        if cause.startswith("No code"):
            return cause
        return f"No code: {cause[:1].lower() + cause[1:]}"


def result_of(reading: ColumnView, decoder: str) -> DecodeResult:
    """Return a decoder's result, or one that says that it is still reading."""
    return reading.results.get(decoder) or DecodeResult(decoder, failure=_WAITING)


def find_wrong_bits(sent: Sequence[int], received: Sequence[int]) -> list[int]:
    pairs = zip(sent, received, strict=False)
    return [index for index, (sent_bit, bit) in enumerate(pairs) if sent_bit != bit]


def is_right(decoded: DecodeResult, sent: Sequence[int]) -> bool:
    return decoded.code is not None and tuple(decoded.bits.tolist()) == tuple(sent)


def failed_decoders(reading: ColumnView) -> tuple[str, ...]:
    """Return the decoders that have not read the code sent; empty if no code is sent."""
    sent, results = reading.sent, reading.results.items()
    return tuple(name for name, result in results if sent and not is_right(result, sent))


def describe_received(sent: str, received: str, wrong: int) -> str:
    return f"sent {sent or 'no code'}, received {received or 'nothing'}, {wrong} wrong"


def describe_missing(reading: Reading) -> str:
    names = ", ".join(reading.missing_effects)
    return f"This picture leaves out effects that the map and the strips include: {names}."


def cause_in(reading: ColumnView, decoded: DecodeResult) -> Cause | None:
    """Return why a decoder has not read the scene; None if unknown, or if it has read it."""
    causes = reading.causes if isinstance(reading, Reading) else None
    return (causes or {}).get(decoded.decoder)


def reason_in(reading: ColumnView, decoded: DecodeResult) -> str:
    """Say why a decoder has not read the scene, and how it failed; may be empty."""
    cause, failure = cause_in(reading, decoded), decoded.failure or ""
    if cause is None:
        return failure
    return f"{cause} {symptom(failure)}".rstrip()


def describe_code(decoded: DecodeResult) -> str:
    """Name the code or payload that a decoder read, as the start of a sentence."""
    if decoded.payload:
        return f"“{one_line(decoded.payload, _LONGEST_PAYLOAD)}”"
    return f"Code {decoded.code}"


def describe_bars(reading: ColumnView) -> tuple[str, str]:
    """Describe the light and the bars in its picture, as a title and an explanation."""
    scene, bars = reading.scene, reading.bars
    title = capitalize(describe_light(scene.transmitter))
    if bars is None:
        return title, ""
    depth = depth_text(bars.peak_to_peak)
    if bars.peak_to_peak <= ROUNDING_DEPTH:
        return f"{title}: no bars", "Every column gathers the same light."
    if bars.peak_to_peak < NO_BARS_DEPTH:
        limit = format_depth(NO_BARS_DEPTH)
        return f"{title}: no bars", f"They are {depth}, and count from {limit}."
    sentence = f"The bars are {depth}. {bars.visibility}"
    if math.isinf(bars.period):
        return f"{title}: bars, but not in these columns", sentence
    return f"{title}: {bars.period:.4g} columns from bar to bar", sentence


def verdict_on(decoded: DecodeResult, sent: Sequence[int]) -> CodeVerdict:
    """Compare a decoder's result with the sent bits, which a raw pattern does not have."""
    if not sent:
        return CodeVerdict(State.NEUTRAL, "No code is sent", decoded.failure or "")
    if decoded.failure == _WAITING:
        title = f"Reading by the decoder {decoded.decoder}"
        return CodeVerdict(State.WAITING, title, decoded.failure)
    if decoded.code is None:
        return CodeVerdict(State.BAD, "No code read", decoded.failure or "")
    if is_right(decoded, sent):
        title = f"{describe_code(decoded)} read, all bits right"
        return CodeVerdict(State.GOOD, title)
    wrong = len(find_wrong_bits(sent, decoded.bits.tolist()))
    title = f"{describe_code(decoded)} read, {wrong} of {len(sent)} bits wrong"
    return CodeVerdict(State.BAD if wrong == len(sent) else State.DOUBTFUL, title)
