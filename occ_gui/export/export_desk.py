"""All that is exported, put together: the figures, where they go, and the menu."""

from collections.abc import Mapping

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QDockWidget, QMainWindow

from occ_gui.decoding.decode_view import DecodeView
from occ_gui.export.export_controller import ExportController
from occ_gui.export.figures import Figures
from occ_gui.files.preferences import Memory
from occ_gui.window.current_pane import PICTURE, FrontPane
from occ_gui.window.desktop_menus import DesktopMenus

_BY_DOCK = {"profile": "profile", "accuracy": "accuracy", "map": "map"}
"""The figures that stand for docks; every other pane is copied as the picture."""


class ExportWiring(QObject):
    """Connects the menu with the figures.

    Parameters
    ----------
    window, docks
        The window and its docks.
    figures
        Knows what each figure is drawn from.
    menus
        Its entries are connected.
    decode
        Whose decoder is copied where this pane is at the front.
    memory
        Remembers the folder.
    """

    def __init__(
        self,
        window: QMainWindow,
        docks: Mapping[str, QDockWidget],
        figures: Figures,
        menus: DesktopMenus,
        decode: DecodeView,
        memory: Memory,
    ) -> None:
        super().__init__(window)
        self._decode = decode
        self.figures = figures
        self.front = FrontPane(window, docks)
        self.controller = ExportController(window, figures, memory)
        for name, action in menus.figures.items():
            action.triggered.connect(lambda _checked=False, name=name: self.controller.ask(name))

    def copy_front(self) -> None:
        """Copy the figure of the pane at the front."""
        self.controller.copy(self._front_figure())

    def _front_figure(self) -> str:
        name = self.front.name
        if name == "decode":
            return f"decoding-{self._decode.decoder()}"
        figure = _BY_DOCK.get(name, PICTURE)
        return figure if figure in self.figures.sources else PICTURE

    def stop(self) -> None:
        """Write no more."""
        self.controller.stop()
