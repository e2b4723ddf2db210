"""The pane that compares the pinned states."""

from occ_gui.pins.compare_view import CompareView
from occ_gui.pins.pin_controller import PinController
from occ_gui.shell.feature import Pane


class ComparePane(Pane[None]):
    """The differences between A and B, and the buttons that pin them."""

    def __init__(self, pins: PinController) -> None:
        view = CompareView()
        super().__init__(view)
        self.view = view
        self._pins = pins
        view.pin_asked.connect(pins.pin)
        view.go_asked.connect(pins.go_to)
        view.clear_asked.connect(pins.clear)
        pins.changed.connect(self._show)
        self._show()

    def _show(self) -> None:
        self.view.show_pinned(self._pins.pinned)

    def set_seen(self, seen: bool) -> None:
        self.view.set_seen(seen)
