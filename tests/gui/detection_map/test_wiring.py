"""What is measured beside the window waits for its first picture, and for the paint of it."""

from typing import Any

import pytest
from gui.stores import store_of
from pytestqt.qtbot import QtBot

from occ_gui.detection_map import wiring
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.wiring import Measuring
from occ_gui.scene.parameter_rows import QuantityRow
from occ_model.scene.parameters import quantity


def test_the_strips_begin_a_while_after_the_picture_has_come(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(wiring, "START_MS", 1)
    row = QuantityRow(quantity("iso"))
    qtbot.addWidget(row)
    strips, asked = SliderStrips({"iso": row}), list[bool]()
    there = [False, False, True, True]

    def has_picture() -> bool:
        asked.append(there[min(len(asked), len(there) - 1)])
        return asked[-1]

    measuring = Measuring(store_of(), strips, has_picture)
    begun: list[Any] = []
    monkeypatch.setattr(measuring, "_set_seen", begun.append)
    strips.seen.emit(True)
    qtbot.waitUntil(lambda: bool(begun))
    assert (asked, begun) == ([False, False, True, True], [True])
    measuring.stop()
