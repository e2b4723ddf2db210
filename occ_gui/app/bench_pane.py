"""Pane of the bench, in a dock that makes it when it is first seen."""

from functools import cached_property
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from occ_gui.background.signals import JobChannel
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.lazy_pane import LazyPane, PaneContent
from occ_gui.window.main_window import MainWindow
from occ_model.results.bench import BenchPoint, BenchRequest

if TYPE_CHECKING:
    from occ_gui.bench.wiring import BenchWiring


class BenchDock(QObject):
    """The dock of the bench.

    Parameters
    ----------
    window
        The window that it is added to, before it is shown.
    scenes, frame_rate
        Whose code is measured, and the pictures a second.
    channel
        Does the work.
    """

    def __init__(
        self, window: MainWindow, scenes: SceneStore, frame_rate: FrameRate, channel: JobChannel
    ) -> None:
        super().__init__()
        self._window = window
        self._scenes, self._frame_rate, self._channel = scenes, frame_rate, channel
        pane = LazyPane(self._make)
        dock = window.add_pane("bench", self.tr("Bench"), pane)
        dock.visibilityChanged.connect(pane.set_seen)

    @cached_property
    def wiring(self) -> "BenchWiring":
        """The pane and its controller, connected."""
        from occ_gui.bench.wiring import BenchWiring

        wiring = BenchWiring(self._scenes, self._frame_rate, self._channel)
        wiring.pane.refused.connect(self._window.say)
        return wiring

    def _make(self) -> PaneContent:
        return self.wiring.pane, self.wiring.set_seen

    @property
    def full(self) -> tuple[BenchRequest, tuple[BenchPoint, ...]] | None:
        """The request and all its points, None while some are missing."""
        return self.wiring.controller.full if "wiring" in vars(self) else None
