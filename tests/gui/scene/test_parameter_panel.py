"""A form of parameter rows."""

import pytest
from gui.kinds import add_widget
from gui.stores import store_of
from PySide6.QtGui import QTextDocumentFragment
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_gui.scene.control_panel import MAIN
from occ_gui.scene.parameter_panel import ParameterPanel
from occ_gui.scene.parameter_rows import CountRow, QuantityRow
from occ_gui.scene.refusal_notice import RefusalNotice
from occ_model.scene.scene import Scene

NAMES = ("distance", "bits", "readout_time")


@pytest.fixture
def panel(qtbot: QtBot) -> ParameterPanel:
    return add_widget(qtbot, ParameterPanel(NAMES))


def labels_of(panel: ParameterPanel) -> list[QLabel]:
    labels = panel.findChildren(QLabel)
    return [label for label in labels if not isinstance(label, RefusalNotice)]


def test_rows_stand_in_the_order_asked_for_under_their_labels(panel: ParameterPanel) -> None:
    panel.show()
    labels = labels_of(panel)
    texts = [QTextDocumentFragment.fromHtml(label.text()).toPlainText() for label in labels]
    assert texts == ["Distance d", "Bits", "Readout time tr"]
    assert list(panel.rows) == list(NAMES)
    tops = [
        widget.y()
        for pair in zip(labels, panel.rows.values(), strict=True)
        for widget in pair
    ]  # fmt: skip
    assert tops == sorted(tops)


def test_a_label_sets_the_symbol_in_italics_and_explains_as_its_control_does(
    panel: ParameterPanel,
) -> None:
    texts = [label.text() for label in labels_of(panel)]
    assert texts[0].endswith("<i>d</i>")
    assert texts[2].endswith("<i>t</i><sub>r</sub>")
    for label, row in zip(labels_of(panel), panel.rows.values(), strict=True):
        assert isinstance(row, QuantityRow | CountRow)
        assert label.toolTip() == row.field.toolTip()


def test_showing_a_scene_shows_its_values_and_tells_nothing(
    panel: ParameterPanel, qtbot: QtBot
) -> None:
    told: list[object] = []
    for row in panel.rows.values():
        row.edited.connect(lambda *edit: told.append(edit))
    panel.show_scene(Scene().replace(distance=0.7, bits=16, readout_time=13e-6))
    distance, bits, readout = panel.rows.values()
    assert isinstance(distance, QuantityRow)
    assert isinstance(bits, CountRow)
    assert isinstance(readout, QuantityRow)
    assert (distance.field.value(), bits.field.value(), readout.field.value()) == (0.7, 16, 13e-6)
    assert told == []
    scene = Scene().replace(distance=0.7)
    panel.show_scene(scene)
    distance = panel.rows["distance"]
    assert isinstance(distance, QuantityRow)
    distance.slider.setValue(300)
    panel.show_scene(scene)
    assert distance.field.value() == 0.7


def test_a_row_does_not_receive_the_value_that_it_sent(
    panel: ParameterPanel, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = store_of()
    store.changed.connect(panel.show_scene)
    panel.show_scene(store.scene)
    distance = panel.rows["distance"]
    assert isinstance(distance, QuantityRow)
    distance.edited.connect(lambda name, value, gesture: store.change(gesture, **{name: value}))
    received: list[str] = []
    for row in panel.rows.values():
        monkeypatch.setattr(row, "_display", lambda _value, name=row.name: received.append(name))
    for position in (300, 310):
        distance.slider.setValue(position)
        assert store.scene.value("distance") == distance.value
    assert received == []
    store.undo_stack.undo()
    assert received == ["distance"]


def test_below_the_last_slider_is_room_for_the_foot_and_for_nothing_else(qtbot: QtBot) -> None:
    """In a low window it is the foot, what the colours mean, that has to go."""
    panel, foot = ParameterPanel(MAIN, with_scales=True), QLabel("foot")
    qtbot.addWidget(panel)
    panel.add_foot(foot)
    panel.resize(400, panel.sizeHint().height())
    panel.show()
    last = panel.rows[MAIN[-1]].geometry()
    assert foot.height() == foot.sizeHint().height()
    assert panel.height() - foot.geometry().bottom() <= 4
    assert foot.geometry().top() - last.bottom() <= 6
