"""Sentences that say why a film's payload was not read."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.receiver.sequence.soft_frame import SoftFrame
from occ_model.video.joining import Joined
from occ_model.video.period import SentPeriod
from occ_model.video.read_frame import TimedFrame

_MIN_CERTAINTY = 0.9  # least probability that all bits are right, of a payload that is read

NO_CLOCK = (
    "The frame times do not determine a clock: no frequency that the readout time allows explains "
    "what the frames show, or too many do. Packets are not counted."
)


def certainty_of(soft: SoftFrame | None, period: SentPeriod) -> float:
    """Return the probability that all bits are right, by the votes and by what the code finds.

    With c the probability that no chip is wrong, -ln c is the expected number of wrong ones. A code
    that finds any single wrong chip has excluded just one; what remains is none, or two and more.
    """
    if soft is None or soft.framed.failure is not None or period.scheme is None:
        return 0.0
    certainty = soft.certainty
    if period.scheme.finds_wrong_chip and 0.0 < certainty < 1.0:
        certainty /= 1.0 + certainty * math.log(certainty)
    return certainty


def why_unplaced(frames: Sequence[TimedFrame]) -> str:
    """Say why no frame could be placed in what is sent: what the first one by itself says."""
    if not frames:
        return "The film holds no frames."
    read = [frame for frame in frames if frame.is_read]
    if not read:
        why = frames[0].reading.failure
        return f"None of {len(frames)} frames shows chips; of the first one: {why}"
    why = read[0].problem
    rest = (
        "no header shows it, and the chips fit no place."
        if why is None
        else f"of the first one: {why}"
    )
    return f"The place in the packet of none of {len(read)} frames with chips is known; {rest}"


def why_not_read(soft: SoftFrame | None, joined: Joined, period: SentPeriod) -> str | None:
    """Say why the chips of all frames, joined, give no payload; None where they do."""
    if period.scheme is None:
        return "A raw chip pattern is sent, which holds no packets."
    if soft is None:
        return _why_incomplete(joined, period)
    if soft.framed.failure is not None:
        return soft.framed.failure
    certainty = certainty_of(soft, period)
    if certainty < _MIN_CERTAINTY and not period.scheme.framing.checks:
        return (
            f"The chips are not certain enough: that all {period.scheme.bits} bits are right has a "
            f"probability of {certainty:.2g}."
        )
    return None


def _why_incomplete(joined: Joined, period: SentPeriod) -> str:
    unseen = ~joined.known
    text = (
        f"{int(unseen.sum())} of {period.length} chips were in no frame: they fell into the gap "
        "each time, or the film is too short."
    )
    if period.parts > 1:
        missing = np.flatnonzero(unseen.reshape(period.parts, -1).any(axis=1))
        text += f" The first sub-packet that lacks some is number {int(missing[0]) + 1}."
    return text
