"""A slider that runs by itself is undone as one change; marks show where the picture changes."""

import numpy as np
import pytest
from gui.kinds import add_widget
from gui.pane_bench import ControlsBench
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QSlider, QToolTip, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.scene.slider_scale import SliderScale
from occ_model.results.teaching import MarkedValue
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

NAME = "switching_frequency"


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> ControlsBench:
    return ControlsBench(qtbot, small_scene)


def press(bench: ControlsBench, name: str = NAME) -> None:
    bench.controls.panels["Main"].play_buttons[name].click()


def test_a_run_moves_the_scene_and_is_undone_at_once(
    bench: ControlsBench, qtbot: QtBot, small_scene: Scene
) -> None:
    store, values = bench.scenes, set[float]()
    store.changed.connect(lambda scene: values.add(scene.transmitter.switching_frequency))
    press(bench)
    qtbot.waitUntil(lambda: len(values) >= 4)
    press(bench)
    assert bench.controls.player.parameter == ""
    store.undo_stack.undo()
    assert store.scene == small_scene


def test_a_run_turns_back_at_the_end_and_without_loop_ends_at_the_start(
    bench: ControlsBench, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    monkeypatch.setattr("occ_gui.scene.player.SPEEDS", {"normal": 0.2})
    player = bench.controls.player
    player.is_looping = False
    values: list[float] = []
    bench.scenes.changed.connect(lambda s: values.append(s.transmitter.switching_frequency))
    player.play(NAME)
    qtbot.waitUntil(lambda: player.parameter == "")
    assert max(values) == 100e3
    assert values.index(max(values)) < len(values) - 1
    assert values[-1] == 500.0


def test_a_value_that_is_entered_ends_the_run_and_another_parameter_does_not(
    bench: ControlsBench, qtbot: QtBot
) -> None:
    player = bench.controls.player
    with qtbot.waitSignal(bench.scenes.changed):
        press(bench)
    bench.scenes.change(switching_frequency=5e3)
    assert player.parameter == ""
    assert bench.scenes.scene.transmitter.switching_frequency == 5e3
    with qtbot.waitSignal(bench.scenes.changed):
        press(bench)
    bench.scenes.change(distance=1.5)
    assert player.parameter == NAME
    press(bench, "iso")
    assert player.parameter == "iso"
    player.stop()


def test_the_menu_sets_speed_and_loop_and_asks_for_a_film(bench: ControlsBench) -> None:
    player, films = bench.controls.player, list[str]()
    player.animation_asked.connect(films.append)
    entries = {action.text(): action for action in player.menu_of(NAME).actions()}
    entries["&Fast"].trigger()
    entries["&Loop"].trigger()
    entries["Save as &animation…"].trigger()
    assert (player.speed, player.is_looping, films) == ("fast", False, [NAME])
    again = {action.text(): action for action in player.menu_of(NAME).actions()}
    assert again["&Fast"].isChecked()
    assert not again["&Loop"].isChecked()


def test_the_marks_follow_the_scene(application: Application) -> None:
    panel = application.controls.panels["Main"]
    (scale,) = panel.rows[NAME].findChildren(SliderScale)
    application.scene_store.change(exposure_time=100e-6)
    assert [mark.value for mark in scale.marks] == pytest.approx([10e3, 20e3])
    assert "10 kHz: Exposure and switching period are equal" in scale.accessibleDescription()
    assert scale.accessibleName() == "From 500 Hz to 100 kHz"
    application.scene_store.change(exposure_time=15e-6)
    assert [mark.value for mark in scale.marks] == pytest.approx([1 / 15e-6])
    QToolTip.hideText()


def test_a_mark_is_named_at_any_value_and_replaces_an_end_value(qtbot: QtBot) -> None:
    whole, gamma = add_widget(qtbot, QWidget()), quantity("gamma")
    slider = QSlider(Qt.Orientation.Horizontal, whole)
    scale = SliderScale(slider, gamma)
    scale.setParent(whole)
    for part in (slider, scale):
        part.setGeometry(0, 0, 170, 30)
    metrics = QFontMetricsF(scale.text_font())
    low, high = gamma.slider
    counts = []
    for fraction in np.linspace(0.0, 1.0, 41):
        scale.show_marks([MarkedValue(float(low + fraction * (high - low)), "t = 1 chip", "")])
        ends, names = scale.place_texts(metrics)
        assert [name for name, _ in names] == ["t = 1 chip"]
        assert not any(box.intersects(names[0][1]) for _, box in ends)
        counts.append(len(ends))
        if fraction == 0.5:
            assert names[0][1].center().x() == pytest.approx(scale.x_of(scale.marks[0].value))
    assert set(counts) == {1, 2}
    assert counts[20] == 2, "a mark in the middle leaves both end values"
    scale.show_marks([])
    assert len(scale.place_texts(metrics)[0]) == 2
