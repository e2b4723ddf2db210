"""All controls of a scene: each parameter once, each control named and explained."""

from collections import Counter
from itertools import pairwise
from typing import Any

import pytest
from gui.kinds import add_widget, collect
from gui.stores import store_of
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLabel,
    QLineEdit,
    QSlider,
    QWidget,
)
from pytestqt.qtbot import QtBot

from occ_gui.scene.control_panel import MAIN, ControlPanel, main_of
from occ_gui.scene.parameter_panel import ParameterPanel
from occ_gui.scene.parameter_rows import ChoiceRow, CountRow, PatternRow, QuantityRow
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.parameters.light import LIGHTS
from occ_model.scene.scene import GROUPS, Scene

EFFECTS = ("edge_time", "jpeg_quality")
PRESETS = [("small", "A small scene"), ("large", "A large scene")]


@pytest.fixture
def panel(qtbot: QtBot) -> ControlPanel:
    panel = ControlPanel(EFFECTS)
    panel.list_presets(PRESETS)
    panel.show_scene(Scene())
    qtbot.addWidget(panel)
    return panel


def choice_of(panel: ControlPanel) -> QComboBox:
    assert isinstance(panel.light, ChoiceRow)
    return panel.light.field


def entry_controls(panel: QWidget) -> list[QWidget]:
    """List the controls that accept values, without the line edits inside number fields."""
    kinds = (QAbstractSpinBox, QComboBox, QLineEdit, QSlider)
    controls = [control for kind in kinds for control in panel.findChildren(kind)]
    return [c for c in controls if not isinstance(c.parentWidget(), QAbstractSpinBox)]


def test_every_parameter_but_the_code_has_exactly_one_row_on_its_page(panel: ControlPanel) -> None:
    rows = Counter(name for page in panel.panels.values() for name in page.rows)
    assert rows == Counter(name for name in PARAMETERS if name not in ("code", "light"))
    first = next(iter(panel.panels.values()))
    assert tuple(first.rows) == MAIN
    assert tuple(panel.panels["Effects"].rows) == EFFECTS


def test_every_row_names_its_parameter_and_its_allowed_range(panel: ControlPanel) -> None:
    for page in panel.panels.values():
        for name, row in page.rows.items():
            controls = entry_controls(row)
            assert controls, name
            for control in controls:
                assert control.accessibleName() == PARAMETERS[name].label
                assert f"Allowed: {PARAMETERS[name].allowed}" in control.toolTip()
    symbols = {
        name: label.text() for page in panel.panels.values() for name, label in page.labels.items()
    }
    assert symbols["readout_time"].endswith("<i>t</i><sub>r</sub>")
    assert symbols["distance"].endswith("<i>d</i>")


def test_all_pages_show_the_scene_and_emit_no_edit(panel: ControlPanel) -> None:
    edits: list[object] = []
    rows: list[Any] = [
        panel.code,
        *(r for page in panel.panels.values() for r in page.rows.values()),
    ]
    for row in rows:
        row.edited.connect(lambda *edit: edits.append(edit))
    scene = Scene().replace(
        code=5, bits=4, pattern="01", distance=0.7, gamma=1.8, averaging="light", rows=77
    )
    panel.show_scene(scene)
    values: dict[str, object] = {
        "code": panel.code.number.value(), "light": choice_of(panel).currentText()
    }  # fmt: skip
    for page in panel.panels.values():
        for name, row in page.rows.items():
            match row:
                case QuantityRow() | CountRow():
                    values[name] = row.field.value()
                case ChoiceRow():
                    values[name] = row.field.currentText()
                case PatternRow():
                    values[name] = row.field.text()
    assert values == {name: scene.value(name) for name in PARAMETERS}
    assert edits == []


@pytest.mark.parametrize("light", LIGHTS)
def test_only_the_rows_of_the_scenes_light_are_shown(panel: ControlPanel, light: str) -> None:
    shown = Scene().replace(light=light)
    panel.show_scene(shown)
    assert choice_of(panel).currentText() == light
    for page in panel.panels.values():
        for name, row in page.rows.items():
            parts = (row, page.labels[name], page.play_buttons.get(name, row))
            is_of_colours = name in GROUPS["colours"] and name != "bayer"
            is_hidden = is_of_colours or not PARAMETERS[name].is_of(light)
            assert {part.isHidden() for part in parts} == {is_hidden}
    for part in (panel.code, panel.code.title):
        assert part.isHidden() == (light != "code")


def test_parameters_of_colour_are_shown_for_a_colour_camera(panel: ControlPanel) -> None:
    panel.show_scene(Scene().replace(bayer="rggb"))
    rows = panel.panels["Model"].rows
    assert not any(rows[name].isHidden() for name in GROUPS["colours"])
    panel.show_scene(Scene())
    assert rows["crosstalk"].isHidden()


def test_other_lights_leave_no_gap_between_the_rows(panel: ControlPanel, qtbot: QtBot) -> None:
    page = panel.panels["Main"]
    panel.resize(300, 900)
    with qtbot.waitExposed(panel):
        panel.show()
    for light in ("lamp", "mains", "code"):
        panel.show_scene(Scene().replace(light=light))
        qtbot.waitUntil(lambda: page.rows["exposure_time"].isVisible())
        QApplication.processEvents()
        visible = [name for name, row in page.rows.items() if row.isVisible()]
        assert tuple(visible) == main_of(light)
        for above, below in pairwise(visible):
            label, row = page.labels[below].geometry(), page.rows[above].geometry()
            assert label.top() - row.bottom() < 20


def test_a_running_slider_stops_where_another_light_has_none(
    panel: ControlPanel, qtbot: QtBot
) -> None:
    store = store_of()
    panel.connect_editor(SceneEditor(store))
    with qtbot.waitSignal(panel.main_rows()["switching_frequency"].edited):
        panel.player.play("switching_frequency")
    panel.show_scene(store.scene.replace(light="lamp"))
    assert panel.player.parameter == ""


def test_edits_and_refusals_of_every_part_are_passed_on(
    panel: ControlPanel, monkeypatch: pytest.MonkeyPatch
) -> None:
    edits: list[object] = []
    editor = SceneEditor(store_of())
    monkeypatch.setattr(SceneStore, "change", lambda _store, _gesture, **edit: edits.extend(edit))
    panel.connect_editor(editor)
    editor.input_refused.connect(edits.append)
    for page in panel.panels.values():
        for name, row in page.rows.items():
            row.edited.emit(name, 1, 1)
    panel.code.edited.emit("code", 1, 1)
    panel.light.edited.emit("light", "lamp", 1)
    panel.code.refused.emit("No such bits.")
    assert Counter(edits) == Counter([*PARAMETERS, "No such bits."])


def test_presets_are_replaced_without_a_signal_and_listed_by_title_or_own_name(
    panel: ControlPanel,
) -> None:
    chosen = collect(panel.preset_chosen)
    panel.list_presets([("mine", "My own"), *PRESETS])
    texts = [panel.preset.itemData(place) for place in range(panel.preset.count())]
    assert texts == ["mine", "small", "large"]
    assert panel.preset.currentIndex() == -1
    assert chosen == []
    panel.list_presets(
        [("phone-68us", "Phone, 68 µs"), ("mine", "Measured")], user_presets=["mine"]
    )
    texts = [panel.preset.itemText(place) for place in range(2)]
    tips = [panel.preset.itemData(place, Qt.ItemDataRole.ToolTipRole) for place in range(2)]
    assert texts == ["Phone, 68 µs", "mine"]
    assert tips == ["phone-68us", "Measured"]


def test_effects_have_a_heading_for_each_stage_of_the_light(qtbot: QtBot) -> None:
    stages = {"edge_time": "light", "flicker_depth": "light", "full_well": "sensor"}
    panel = add_widget(qtbot, ControlPanel(list(stages), stages))
    page = panel.panels["Effects"]
    bold = [label for label in page.findChildren(QLabel) if label.font().bold()]
    assert [label.text() for label in bold] == ["Light: LED and room", "Sensor"]


NAMES = ("distance", "bits", "readout_time")


@pytest.fixture
def form(qtbot: QtBot) -> ParameterPanel:
    return add_widget(qtbot, ParameterPanel(NAMES))


def test_a_row_that_was_moved_shows_the_scene_again(form: ParameterPanel) -> None:
    scene = Scene().replace(distance=0.7)
    form.show_scene(scene)
    distance = form.rows["distance"]
    assert isinstance(distance, QuantityRow)
    distance.slider.setValue(300)
    form.show_scene(scene)
    assert distance.field.value() == 0.7


def test_what_is_being_typed_stays_while_another_parameter_changes(
    form: ParameterPanel, qtbot: QtBot
) -> None:
    form.show_scene(Scene())
    readout = form.rows["readout_time"]
    assert isinstance(readout, QuantityRow)
    readout.field.selectAll()
    qtbot.keyClicks(readout.field, "12")
    form.show_scene(Scene().replace(distance=0.7))
    assert readout.field.text() == "12"
