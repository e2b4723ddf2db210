"""Placement of a photo on the simulated picture: its shift and scale, and the store of it."""

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

MODES = ("beside", "blend", "split", "difference")
"""Ways of showing a photo with the simulated picture."""

LEAST_SCALE, LARGEST_SCALE = 0.01, 100.0
"""Smallest and largest scale of a photo."""


@dataclass(frozen=True, slots=True)
class Placement:
    """Shift and scale of a photo on the simulated picture.

    Parameters
    ----------
    column, row
        The pixel of the simulated picture under the photo's first pixel.
    scale
        Pixels of the simulated picture per pixel of the photo.
    """

    column: float = 0.0
    row: float = 0.0
    scale: float = 1.0


class PlacementStore(QObject):
    """Holds the placement: an automatic one until the user chooses another."""

    changed = Signal(object)
    """The new placement."""

    def __init__(self) -> None:
        super().__init__()
        self._automatic = Placement()
        self._by_hand: Placement | None = None

    @property
    def placement(self) -> Placement:
        return self._automatic if self._by_hand is None else self._by_hand

    @property
    def is_by_hand(self) -> bool:
        return self._by_hand is not None

    def suggest(self, placement: Placement) -> None:
        """Set the automatic placement; it takes effect unless the user chose one."""
        self._put(placement, self._by_hand)

    def move(self, placement: Placement) -> None:
        """Set the placement that the user chose."""
        scale = min(max(placement.scale, LEAST_SCALE), LARGEST_SCALE)
        self._put(self._automatic, Placement(placement.column, placement.row, scale))

    def reset(self) -> None:
        self._put(self._automatic, None)

    def _put(self, automatic: Placement, by_hand: Placement | None) -> None:
        before = (self.placement, self.is_by_hand)
        self._automatic, self._by_hand = automatic, by_hand
        if (self.placement, self.is_by_hand) != before:
            self.changed.emit(self.placement)
