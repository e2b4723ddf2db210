"""Where a photo lies on the simulated picture: one frozen value, changed in one place."""

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

LEAST_SCALE, LARGEST_SCALE = 0.01, 100.0
"""How much a photo can be made smaller and larger."""


@dataclass(frozen=True, slots=True)
class Placement:
    """A photo's place on the simulated picture.

    Parameters
    ----------
    column, row
        The pixel of the simulated picture that the photo's first one lies on.
    scale
        Pixels of the simulated picture to one of the photo.
    """

    column: float = 0.0
    row: float = 0.0
    scale: float = 1.0


class PlacementStore(QObject):
    """Holds the placement: one that suits the pictures, until the user chooses another."""

    changed = Signal(object)
    """The new placement."""

    def __init__(self) -> None:
        super().__init__()
        self._fitting = Placement()
        self._by_hand: Placement | None = None

    @property
    def placement(self) -> Placement:
        """The placement as it is now."""
        return self._fitting if self._by_hand is None else self._by_hand

    @property
    def is_by_hand(self) -> bool:
        """Whether the user chose it."""
        return self._by_hand is not None

    def suggest(self, placement: Placement) -> None:
        """Say which placement suits the pictures; it holds unless the user chose one."""
        self._put(placement, self._by_hand)

    def move(self, placement: Placement) -> None:
        """Place the photo by hand."""
        scale = min(max(placement.scale, LEAST_SCALE), LARGEST_SCALE)
        self._put(self._fitting, Placement(placement.column, placement.row, scale))

    def reset(self) -> None:
        """Go back to the placement that suits the pictures."""
        self._put(self._fitting, None)

    def _put(self, fitting: Placement, by_hand: Placement | None) -> None:
        before = (self.placement, self.is_by_hand)
        self._fitting, self._by_hand = fitting, by_hand
        if (self.placement, self.is_by_hand) != before:
            self.changed.emit(self.placement)
