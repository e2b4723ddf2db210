"""Verdict on a decoder's result: the code read, compared with the one sent, in words."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from occ_gui.simulation.snapshot import ColumnView
from occ_gui.widgets.state_look import State
from occ_model.errors import one_line
from occ_model.results import DecodeResult

_LONGEST_PAYLOAD = 24
"""Characters of a payload that a title shows."""

_CLAUSE_END = re.compile(r"[:;,.](?= |$)")


@dataclass(frozen=True, slots=True)
class Verdict:
    """What a decoder's result is worth.

    Parameters
    ----------
    state
        Good where all bits are right, doubtful where some are, bad where none is or no code was
        read, neutral where none is sent, waiting while a slow decoder reads.
    title
        The verdict in a few words.
    reason
        The decoder's sentence that says why no code was read, else empty.
    """

    state: State
    title: str
    reason: str = ""

    @property
    def explanation(self) -> str:
        """The rest of the reason, which the heading begins; empty where there is none."""
        parts = _CLAUSE_END.split(self.reason, maxsplit=1)
        if self.state is not State.BAD or len(parts) < 2:
            return self.reason
        rest = parts[1].strip()
        return rest[:1].upper() + rest[1:]

    @property
    def heading(self) -> str:
        """The verdict in one line, with the beginning of the reason where there is one."""
        if not self.reason or self.state is not State.BAD:
            return self.title
        cause = _CLAUSE_END.split(self.reason, maxsplit=1)[0]
        if cause.startswith(_tr("No code")):
            return cause
        return _tr("No code: {cause}").format(cause=cause[:1].lower() + cause[1:])


def result_of(reading: ColumnView, decoder: str) -> DecodeResult:
    """Return what a decoder read; of one that has not read yet, that it will."""
    found = (result for result in reading.results if result.decoder == decoder)
    return next(found, None) or DecodeResult(decoder, failure=_awaited())


def _awaited() -> str:
    return _tr("This decoder takes longer: it reads the picture now.")


def wrong_places(sent: Sequence[int], received: Sequence[int]) -> list[int]:
    """Return the indices of the received bits that differ from the sent ones."""
    pairs = zip(sent, received, strict=False)
    return [place for place, (one, other) in enumerate(pairs) if one != other]


def is_right(decoded: DecodeResult, sent: Sequence[int]) -> bool:
    """Return whether a code was read, and it is the one sent."""
    return decoded.code is not None and tuple(decoded.bits.tolist()) == tuple(sent)


def what_was_read(decoded: DecodeResult) -> str:
    """Name the code or the payload that a decoder read, as the start of a sentence."""
    if decoded.payload:
        return _tr("“{payload}”").format(payload=one_line(decoded.payload, _LONGEST_PAYLOAD))
    return _tr("Code {code}").format(code=decoded.code)


def verdict_on(decoded: DecodeResult, sent: Sequence[int]) -> Verdict:
    """Compare what a decoder read with the bits sent; these are empty for a raw pattern."""
    if not sent:
        return Verdict(State.NEUTRAL, _tr("No code is sent"), decoded.failure or "")
    if decoded.failure == _awaited():
        title = _tr("Reading by the decoder {name}").format(name=decoded.decoder)
        return Verdict(State.WAITING, title, decoded.failure)
    if decoded.code is None:
        return Verdict(State.BAD, _tr("No code read"), decoded.failure or "")
    if is_right(decoded, sent):
        title = _tr("{what} read, all bits right").format(what=what_was_read(decoded))
        return Verdict(State.GOOD, title)
    wrong = len(wrong_places(sent, decoded.bits.tolist()))
    title = _tr("{what} read, {wrong} of {bits} bits wrong").format(
        what=what_was_read(decoded), wrong=wrong, bits=len(sent)
    )
    return Verdict(State.BAD if wrong == len(sent) else State.DOUBTFUL, title)


def _tr(text: str) -> str:
    return QCoreApplication.translate("Verdict", text)
