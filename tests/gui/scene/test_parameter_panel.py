"""A form of parameter rows."""

import pytest
from PySide6.QtGui import QTextDocumentFragment
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_gui.scene.parameter_panel import ParameterPanel
from occ_gui.scene.parameter_rows import CountRow, QuantityRow
from occ_model.scene.scene import Scene

NAMES = ("distance", "bits", "readout_time")


@pytest.fixture
def panel(qtbot: QtBot) -> ParameterPanel:
    panel = ParameterPanel(NAMES)
    qtbot.addWidget(panel)
    return panel


def test_rows_stand_in_the_order_asked_for_under_their_labels(panel: ParameterPanel) -> None:
    panel.show()
    labels = panel.findChildren(QLabel)
    texts = [QTextDocumentFragment.fromHtml(label.text()).toPlainText() for label in labels]
    assert texts == ["Distance d", "Bits", "Readout time tr"]
    assert list(panel.rows) == list(NAMES)
    tops = [
        widget.y()
        for pair in zip(labels, panel.rows.values(), strict=True)
        for widget in pair
    ]  # fmt: skip
    assert tops == sorted(tops)


def test_a_label_sets_the_symbol_in_italics_and_its_index_low(panel: ParameterPanel) -> None:
    texts = [label.text() for label in panel.findChildren(QLabel)]
    assert texts[0].endswith("<i>d</i>")
    assert texts[2].endswith("<i>t</i><sub>r</sub>")


def test_a_label_explains_as_its_control_does(panel: ParameterPanel) -> None:
    for label, row in zip(panel.findChildren(QLabel), panel.rows.values(), strict=True):
        assert isinstance(row, QuantityRow | CountRow)
        assert label.toolTip() == row.field.toolTip()


def test_showing_a_scene_shows_its_values_and_tells_nothing(
    panel: ParameterPanel, qtbot: QtBot
) -> None:
    told: list[object] = []
    panel.edited.connect(lambda *edit: told.append(edit))
    panel.show_scene(Scene().replace(distance=0.7, bits=16, readout_time=13e-6))
    distance, bits, readout = panel.rows.values()
    assert isinstance(distance, QuantityRow)
    assert isinstance(bits, CountRow)
    assert isinstance(readout, QuantityRow)
    assert (distance.field.value(), bits.field.value(), readout.field.value()) == (0.7, 16, 13e-6)
    assert told == []


def test_the_panel_passes_on_what_its_rows_tell(panel: ParameterPanel) -> None:
    told: list[object] = []
    panel.edited.connect(lambda *edit: told.append(edit))
    panel.refused.connect(told.append)
    panel.rows["distance"].edited.emit("distance", 0.5, 7)
    panel.rows["bits"].refused.emit("bits is 0.")
    assert told == [("distance", 0.5, 7), "bits is 0."]
