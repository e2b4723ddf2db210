"""The path of a value from a slider to the painted pixel, counted in functions."""

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

import pytest
from gui.user import User
from PySide6.QtCore import Qt

from occ_gui.app.application import Application
from occ_gui.background.task import Task
from occ_gui.picture.averaged_image import AveragedImage

MOST_FUNCTIONS = 19
"""There were 12 when each pane was called by name. Three more are the store's and the task's, and
four the same for every pane: the board takes the picture and tells of it, the pane's place looks
whether its part differs, and the pane shows it. These are a part of a thousandth of a second."""


class CallPath:
    """The functions of the window that are running wherever a call is watched."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.functions: dict[str, None] = {}
        self._monkeypatch = monkeypatch

    def watch(self, owner: object, name: str) -> None:
        """Note the running functions whenever a function is called, and the function itself."""
        watched: Callable[..., object] = getattr(owner, name)

        def call(*arguments: Any, **named: Any) -> object:
            self.note(sys._getframe(1))
            if watched.__module__.startswith("occ_gui"):
                self.functions[watched.__qualname__] = None
            return watched(*arguments, **named)

        self._monkeypatch.setattr(owner, name, call)

    def note(self, frame: FrameType | None) -> None:
        """Note the functions of the window among a frame and its callers."""
        running = []
        while frame is not None:
            if frame.f_globals.get("__name__", "").startswith("occ_gui"):
                running.append(frame.f_code.co_qualname)
            frame = frame.f_back
        self.functions.update(dict.fromkeys(reversed(running)))


def test_a_slider_reaches_the_pixel_in_at_most_nineteen_functions(
    application: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    slider = application.controls.main_rows()["exposure_time"].slider
    slider.setSliderDown(True)
    slider.setValue(400)
    user.wait_until_idle()
    path = CallPath(monkeypatch)
    path.watch(Task, "ask")
    path.watch(AveragedImage, "set_image")
    application.simulation.runner._worker.reported.connect(
        lambda _run, _picture: path.note(sys._getframe(1)), Qt.ConnectionType.DirectConnection
    )
    seen = application.store.scene
    slider.setValue(410)
    user.wait_until_idle()
    assert application.store.scene != seen
    functions = [*path.functions, "AveragedImage.paint"]
    ends = ("QuantityRow._slide", "_Worker.run", "AveragedImage.set_image")
    assert set(ends) <= set(functions)
    assert len(functions) <= MOST_FUNCTIONS, "\n".join(functions)
