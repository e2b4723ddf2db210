"""Result of reading chips from a photo without its scene."""

from dataclasses import dataclass

from occ_model.arrays import ByteArray
from occ_model.results.decoding import Region


@dataclass(frozen=True, eq=False, slots=True)
class ChipReading:
    """Chips read from a photo's stripes without knowledge of the code or its repetition.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        The chips between the first and the last edge in view.
    columns_per_chip
        Length of a chip in columns.
    confidence
        Probability, from 0 to 1, that all chips are right, calibrated on simulated messages.
    start
        Column of the photo at which the first chip starts.
    region
        The rectangle of the photo that was read.
    """

    chips: ByteArray
    columns_per_chip: float
    confidence: float
    start: float
    region: Region

    @property
    def text(self) -> str:
        """The chips as a text of zeros and ones."""
        return "".join(map(str, self.chips.tolist()))
