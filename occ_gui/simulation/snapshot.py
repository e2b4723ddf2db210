"""What one simulation gives the views to show."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.results import DecodeResult, Frame


@dataclass(frozen=True, eq=False, slots=True)
class Snapshot:
    """The results for one scene.

    Parameters
    ----------
    frame
        The simulated picture.
    decoded
        What the paper's decoder made of it.
    others
        What the other decoders made of the same signal.
    sent
        The bits sent, the first sent first; empty where a raw pattern is sent.
    packet_columns
        Columns that one period of what is sent spans in the picture.
    panel_origin
        Column and row of the panel's upper left corner in the picture, or of the picture's where
        the panel reaches beyond it.
    band : ndarray of float64, shape (columns,), or None
        The band model's profile, None where ``band_undefined`` says why there is none.
    band_undefined
        A sentence, empty where there is a profile.
    reading_seconds
        Time that the paper's decoder took.
    """

    frame: Frame
    decoded: DecodeResult
    sent: tuple[int, ...]
    packet_columns: float
    panel_origin: tuple[float, float]
    band: FloatArray | None
    band_undefined: str
    reading_seconds: float
    others: tuple[DecodeResult, ...] = ()

    @property
    def simulation_seconds(self) -> float:
        """Time that the simulation of the picture took."""
        return sum(self.frame.timings.values())
