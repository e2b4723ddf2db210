"""Reading of a film, ready to be shown: marks of the timeline, text, facts and sentences."""

from dataclasses import dataclass, field

import numpy as np

from occ_gui.video.marks import Marks
from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.fact import Fact


@dataclass(frozen=True, eq=False, slots=True)
class FilmReading:
    # Shape (frames,): when the frames that were looked at began, in seconds
    times: FloatArray
    states: ByteArray  # shape (frames,): A :class:`~occ_gui.video.marks.MarkState` each
    packets: Marks = field(default_factory=Marks)
    text: str = ""
    facts: tuple[Fact, ...] = ()
    sentences: tuple[str, ...] = ()

    @classmethod
    def nothing(cls) -> "FilmReading":
        return cls(np.zeros(0, dtype=np.float64), np.zeros(0, dtype=np.uint8))
