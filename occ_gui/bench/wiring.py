"""Wiring of the bench: its pane and its controller, made when the pane is first seen."""

from PySide6.QtCore import QObject

from occ_gui.background.signals import JobChannel
from occ_gui.bench.bench_controller import BenchController
from occ_gui.bench.bench_view import BenchView
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.scene_store import SceneStore
from occ_model.receiver.decoders import decoders

FIRST_DECODERS = ("threshold", "equalizer", "sequence")
"""Decoders of payloads of any length."""


class BenchWiring(QObject):
    """The pane and its controller, connected.

    Parameters
    ----------
    scenes, frame_rate
        Whose code is measured, and the pictures a second.
    channel
        Does the work.
    """

    def __init__(self, scenes: SceneStore, frame_rate: FrameRate, channel: JobChannel) -> None:
        super().__init__()
        self.pane = BenchView(decoders(), FIRST_DECODERS)
        self.controller = BenchController(scenes, frame_rate, channel, self.pane)
        self.controller.choose(self.pane.choice())
        self.pane.choice_changed.connect(self.controller.choose)
        self.pane.asked.connect(self.controller.start)
        self.pane.cancelled.connect(self.controller.cancel)
        self.pane.frame_rate_edited.connect(frame_rate.change)

    def set_seen(self, _seen: bool) -> None:
        """Go on whether or not the pane is seen: somebody waits for the answer."""
