"""The strips under the main sliders."""

import numpy as np
from PySide6.QtCore import QEvent, QObject, Signal

from occ_gui.detection_map.map_colours import RATES, painted
from occ_gui.detection_map.slider_strip import SliderStrip
from occ_gui.scene.parameter_rows import QuantityRow
from occ_model.arrays import ByteArray, FloatArray
from occ_model.scene.parameters import PARAMETERS


class SliderStrips(QObject):
    """A strip under each of some sliders.

    Parameters
    ----------
    rows
        The sliders' rows, by the names of their parameters.
    parent
        The parent.
    """

    seen = Signal(bool)
    """Whether anybody can see them from now on."""

    def __init__(self, rows: dict[str, QuantityRow], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.strips: dict[str, SliderStrip] = {}
        for name, row in rows.items():
            strip = SliderStrip(row.slider, PARAMETERS[name].label, _colours)
            row.add_below(strip)
            self.strips[name] = strip
        next(iter(self.strips.values())).installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Tell when the first strip comes into sight or goes."""
        if event.type() in (QEvent.Type.Show, QEvent.Type.Hide):
            self.seen.emit(event.type() == QEvent.Type.Show)
        return super().eventFilter(watched, event)

    def set_shown(self, shown: bool) -> None:
        """Show or hide the strips."""
        for strip in self.strips.values():
            strip.setVisible(shown)

    def show_shares(self, name: str, shares: tuple[float | None, ...]) -> None:
        """Show the share of bits read rightly at positions along a slider, None: not known."""
        self.strips[name].show_shares(shares)


def _colours(shares: FloatArray) -> ByteArray:
    return np.asarray(painted(np.atleast_2d(shares), 0.0, 1.0, RATES)[0])
