"""Pane of the photo: its facts, a failed match, and its placement."""

from dataclasses import replace
from pathlib import Path

from gui.combo_box import choose
from gui.photo.photo_bench import LiveView
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.values.placement import Placement
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match


def test_without_a_photo_all_a_user_can_press_opens_one(view: LiveView, qtbot: QtBot) -> None:
    assert not view.form.isVisible()
    visible = [b for b in view.findChildren(type(view.form.start)) if b.isVisible()]
    able = [button for button in visible if button.isEnabled()]
    assert {button.text() for button in able} == {"1 Open", "&Open photos…"}
    for button in able:
        with qtbot.waitSignal(view.open_asked, timeout=1000):
            qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_a_page_without_a_photo_offers_each_sample(view: LiveView, qtbot: QtBot) -> None:
    paths = [Path("square-wave.png"), Path("packet.png")]
    view.show_samples(dict(zip(("Square wave", "Packet"), paths, strict=True)))
    buttons = [one for one in view.findChildren(QPushButton) if one.text().startswith("Sample")]
    assert [one.text() for one in buttons] == [
        "Sample: Square wave (simulated)", "Sample: Packet (simulated)"
    ]  # fmt: skip
    for path, button in zip(paths, buttons, strict=True):
        with qtbot.waitSignal(view.sample_chosen) as opened:
            button.click()
        assert opened.args == [path]


def test_what_is_known_of_a_photo_is_shown_with_its_units(view: LiveView, photo: Photo) -> None:
    noted = replace(
        photo,
        exposure_time=1 / 8000,
        iso=12800.0,
        f_number=1.8,
        camera="Maker Model 5",
        turned=True,
    )
    view.open(noted)
    facts = view.facts
    assert facts.name.toolTip().endswith("stripes.png")
    assert facts.size_line.toolTip() == "Maker Model 5, 60 x 100 px, grey, turned"
    assert facts.notes.toolTip() == "125 µs, ISO 12800, f/1.8"
    assert facts.use_settings.isEnabled()


def test_another_photo_is_shown_from_its_name_on(view: LiveView, photo: Photo) -> None:
    view.open(photo)
    view.resize(380, 300)
    bar = view._scroll.verticalScrollBar()
    QApplication.processEvents()
    for path, place in ((photo.path, bar.maximum()), (photo.path.with_name("b.png"), 0)):
        bar.setValue(bar.maximum())
        view.open(replace(photo, path=path))
        assert bar.value() == place
    assert bar.maximum() > 0


def test_a_photo_without_notes_offers_none(view: LiveView, photo: Photo) -> None:
    view.open(photo)
    assert view.facts.size_line.toolTip() == "100 x 60 px, grey"
    assert not view.facts.use_settings.isEnabled()


def test_a_raw_photo_says_that_it_has_no_gamma(view: LiveView, photo: Photo) -> None:
    view.open(replace(photo, is_linear=True))
    assert view.facts.size_line.toolTip() == "100 x 60 px, grey, RAW: gamma 1"


def test_using_the_photos_settings_emits_a_signal(
    view: LiveView, photo: Photo, qtbot: QtBot
) -> None:
    view.open(replace(photo, iso=400.0))
    with qtbot.waitSignal(view.facts.settings_asked):
        qtbot.mouseClick(view.facts.use_settings, Qt.MouseButton.LeftButton)


def test_every_channel_and_scan_axis_of_the_model_can_be_chosen(
    view: LiveView, photo: Photo, qtbot: QtBot
) -> None:
    view.open(photo)
    received: list[str] = []
    view.facts.channel_chosen.connect(received.append)
    view.facts.scan_axis_chosen.connect(received.append)
    choices = ((view.facts.channel, CHANNELS), (view.facts.scan_axis, SCAN_AXES))
    for control, keys in choices:
        assert [control.itemData(place) for place in range(control.count())] == list(keys)
        choose(qtbot, control, keys[1])
    assert received == [CHANNELS[1], SCAN_AXES[1]]
    view.facts.show_reading("red", "lines")
    assert (view.facts.channel.key(), view.facts.scan_axis.key()) == ("red", "lines")
    assert len(received) == 2


def test_a_failure_is_a_sentence_and_what_was_found_before_stays(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.show_matched(match)
    view.show_match_begun()
    view.show_match_ended()
    view.verdict.show_ended(["No scene explains these stripes."])
    assert "No scene explains these stripes." in view.verdict.accessibleDescription()
    assert view.result.isVisible()
    assert view.form.start.isVisible()
    view.show_match_begun()
    assert "No scene" not in view.verdict.accessibleDescription()


def test_the_fields_show_where_the_photo_lies_and_tell_nothing(
    view: LiveView, photo: Photo
) -> None:
    received: list[Placement] = []
    view.placement.placed.connect(received.append)
    view.open(photo)
    view.placement.show_placement(Placement(862.237, 3.5, 1.25), by_hand=True)
    form = view.placement
    assert (form.column.value(), form.row.value(), form.scale.value()) == (862.24, 3.5, 1.25)
    assert form.reset.isEnabled()
    assert received == []
    view.placement.show_placement(Placement(), by_hand=False)
    assert not form.reset.isEnabled()


def test_a_changed_field_moves_the_photo_and_keeps_other_digits(
    view: LiveView, photo: Photo, qtbot: QtBot
) -> None:
    received: list[Placement] = []
    view.placement.placed.connect(received.append)
    view.open(photo)
    view.placement.show_placement(Placement(862.237123, 3.5, 1.0), by_hand=False)
    field = view.placement.row
    field.selectAll()
    qtbot.keyClicks(field, "10")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert received == [Placement(862.237123, 10.0, 1.0)]


def test_moving_by_mouse_and_resetting_emit_signals(
    view: LiveView, photo: Photo, qtbot: QtBot
) -> None:
    view.open(photo)
    view.placement.show_placement(Placement(), by_hand=True)
    with qtbot.waitSignal(view.placement.moving_chosen) as moving:
        qtbot.mouseClick(view.placement.by_mouse, Qt.MouseButton.LeftButton)
    assert moving.args == [True]
    with qtbot.waitSignal(view.placement.reset_asked):
        qtbot.mouseClick(view.placement.reset, Qt.MouseButton.LeftButton)


def test_the_placement_reads_a_decimal_comma_and_refuses_the_rest(
    view: LiveView, photo: Photo, qtbot: QtBot
) -> None:
    placed: list[Placement] = []
    view.placement.placed.connect(placed.append)
    view.open(photo)
    form = view.placement

    def enter(field: QWidget, text: str) -> None:
        field.setFocus()
        qtbot.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        qtbot.keyClicks(field, text)
        qtbot.keyClick(field, Qt.Key.Key_Return)

    enter(form.column, "12,5")
    enter(form.row, "-3.25 px")
    enter(form.scale, "1,5")
    assert placed[-1] == Placement(12.5, -3.25, 1.5)
    count = len(placed)
    for field, text in ((form.column, "1,000"), (form.row, "left"), (form.scale, "0")):
        shown = field.text()
        enter(field, text)
        assert form.notices[field].isVisible()
        assert "cannot be" in form.notices[field].text()
        assert field.text() == shown
    assert len(placed) == count
    enter(form.column, "13")
    assert not form.notices[form.column].isVisible()
    assert placed[-1].column == 13.0


def test_nothing_of_the_page_is_cut_off_at_the_panes_least_width(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.show_matched(match)
    view.resize(view.minimumSizeHint().width(), 700)
    QApplication.processEvents()
    assert view.width() == view.minimumSizeHint().width()
    assert view._scroll.horizontalScrollBar().maximum() == 0
