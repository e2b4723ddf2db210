"""A refused value has a sentence at its field until it is corrected."""

from dataclasses import replace

from gui.stores import store_of
from gui.user import User
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.scene.number_edits import CountEdit
from occ_gui.scene.refusal_notice import RefusalNotice
from occ_model.scene.parameters import count


def count_red_pixels(field: QWidget) -> int:
    """Count the red pixels in the middle row of a field."""
    image = field.grab().toImage()
    middle = image.height() // 2
    return sum(
        image.pixelColor(x, middle).red() > 1.5 * image.pixelColor(x, middle).green()
        for x in range(image.width())
    )


def test_typing_the_old_value_or_changing_the_scene_ends_a_refusal(
    user: User, application: Application
) -> None:
    for name in ("distance", "bits"):
        row = user.row(name)
        text = row.field.text()
        user.enter(name, "soon")
        assert row.notice.text()
        user.enter(name, text)
        assert row.notice.text() == ""
        assert name != "distance" or user.message == ""
    row = user.row("distance")
    user.enter("distance", "0 m")
    application.scene_store.change(iso=250.0)
    assert row.notice.text() == ""
    user.enter("distance", "0 m")
    user.choose("&Undo")
    assert row.notice.text() == ""
    assert user.message == "Undone: change of ISO speed."
    user.enter("distance", "0 m")
    user.choose_next_preset()
    assert row.notice.text() == user.message == ""


def test_a_refusal_of_the_scene_is_shown_at_the_edited_field(
    application: Application, user: User
) -> None:
    user.enter("bits", "3")  # the code, 718, has ten
    row = user.row("bits")
    assert "718" in row.notice.text()
    below = row.notice.mapToGlobal(row.notice.rect().topLeft()).y()
    assert 0 < below - row.field.mapToGlobal(row.field.rect().bottomLeft()).y() < 9
    assert application.controls.code.notices[0].text() == ""


def test_fields_show_why_there_is_no_picture_and_a_picture_ends_only_that(
    application: Application, user: User
) -> None:
    user.change(distance=0.1, yaw=1.2)
    names = ("distance", "yaw", "pitch")
    for name in names:
        assert user.row(name).notice.text() == user.message
    user.enter("distance", "0.11 m")  # no picture either
    assert all("behind" in user.row(name).notice.text() for name in names)
    user.enter("yaw", "0")
    assert not any(user.row(name).notice.text() for name in names)
    user.change(distance=0.1, yaw=1.2)
    application.controls.show_problem("iso is 0; allowed: 1 to 2.", ("iso",))
    application.results_store.put(
        replace(application.results_store.results, failure=None)
    )  # there is a picture
    assert user.row("iso").notice.text()
    assert user.row("yaw").notice.text() == ""


def test_the_sentence_goes_with_the_next_key_escape_or_focus_and_there_is_one_at_a_time(
    application: Application, user: User, qtbot: QtBot
) -> None:
    distance, bits, pattern = (user.row(name) for name in ("distance", "bits", "exposure_time"))
    for end in (
        lambda: qtbot.keyClick(distance.field, Qt.Key.Key_5),
        lambda: qtbot.keyClick(distance.field, Qt.Key.Key_Escape),
        lambda: pattern.field.setFocus(),
    ):
        distance.field.setFocus()
        user.enter("distance", "0 m")
        QApplication.processEvents()
        assert distance.notice.isVisible()
        # The field shows the last value again, which is valid.
        assert count_red_pixels(distance.field) == 0
        end()
        assert not distance.notice.isVisible()
        assert distance.notice.text() == ""
    for row in (distance, pattern):
        user.enter(row.name, "soon")
        QApplication.processEvents()
    notices = application.window.findChildren(RefusalNotice)
    assert [notice for notice in notices if notice.isVisible()] == [pattern.notice]
    assert bits.notice.text() == ""


def test_what_is_wrong_with_a_present_value_is_said_again_at_its_field(
    application: Application, user: User
) -> None:
    user.change(distance=0.1, yaw=1.2)
    QApplication.processEvents()
    row = user.row("distance")
    user.row("iso").field.setFocus()
    assert not row.notice.isVisible()
    assert count_red_pixels(row.field) > 0
    row.field.setFocus()
    assert row.notice.isVisible()
    assert row.notice.parentWidget().rect().contains(row.notice.geometry())


def test_a_refused_field_is_framed_red_and_described(qtbot: QtBot) -> None:
    field = CountEdit(count("columns"))
    notice = RefusalNotice(field)
    for widget in (field, notice):
        qtbot.addWidget(widget)
    field.resize(90, 30)
    before = count_red_pixels(field)
    notice.show_problem("Columns cannot be 0; allowed: 1 to 2.")
    assert field.accessibleDescription() == notice.text() == "Columns cannot be 0; allowed: 1 to 2."
    assert count_red_pixels(field) >= before + 4
    notice.end()
    assert field.accessibleDescription() == ""
    assert count_red_pixels(field) == before


def test_a_refused_change_names_the_parameters_at_fault() -> None:
    store, at_fault = store_of(), []
    store.refused_for.connect(lambda _, names: at_fault.append(names))
    store.change(iso=200.0, distance=-1.0)
    store.change(bits=3)
    assert at_fault == [("distance",), ("bits",)]
