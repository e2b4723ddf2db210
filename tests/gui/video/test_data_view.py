"""Data of a film: text that grows keeps what is selected, and figures stand in their order.

The page in front alone takes height from the pictures.
"""

import numpy as np
import pytest
from gui.kinds import show_widget
from PySide6.QtGui import QTextCursor
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.video.data_view import DataView
from occ_gui.video.film_reading import FilmReading
from occ_gui.video.video_view import VideoView
from occ_model.results.fact import Fact


@pytest.fixture
def view(qtbot: QtBot) -> DataView:
    return show_widget(qtbot, DataView())


def reading(text: str = "", *figures: str, sentences: tuple[str, ...] = ()) -> FilmReading:
    shown = tuple(Fact(name, name, f"{name} 1", meaning=f"What {name} is.") for name in figures)
    states = np.zeros(0, dtype=np.uint8)
    return FilmReading(np.zeros(0), states, text=text, facts=shown, sentences=sentences)


def test_text_that_grows_keeps_what_is_selected_and_is_followed_where_its_end_is_in_view(
    view: DataView,
) -> None:
    view.show_reading(reading("HEL"))
    cursor = view.text.textCursor()
    cursor.setPosition(0)
    cursor.setPosition(2, QTextCursor.MoveMode.KeepAnchor)
    view.text.setTextCursor(cursor)
    view.show_reading(reading("HELLO"))
    assert view.text.toPlainText() == "HELLO"
    assert view.text.textCursor().selectedText() == "HE"
    view.show_reading(reading("J.LLO"))
    assert view.text.toPlainText() == "J.LLO"
    text = "\n".join(map(str, range(200)))
    view.show_reading(reading(text))
    bar = view.text.verticalScrollBar()
    bar.setValue(bar.maximum())
    view.show_reading(reading(text := text + "\nmore" * 50))
    assert bar.value() == bar.maximum()
    bar.setValue(7)
    view.show_reading(reading(text + "\nmore" * 50))
    assert bar.value() == 7


def test_figures_stand_in_their_order_above_what_is_not_sure(view: DataView, qtbot: QtBot) -> None:
    def shown() -> list[str]:
        return [name.text() for name, value in view.rows if value.isVisible()]

    view.show_reading(reading("", "b", "d"))
    view.show_reading(reading("", "a", "b", "c", "d"))
    assert shown() == list("abcd")

    def check() -> None:
        tops = [value.y() for _, value in view.rows]
        assert tops == sorted(set(tops))

    qtbot.waitUntil(check)
    _, value = view.rows[2]
    assert (value.text(), value.accessibleName(), value.toolTip()) == ("c 1", "c", "What c is.")
    view.show_reading(reading("", "d", "a"))
    assert shown() == ["d", "a"]
    view.show_reading(reading(sentences=("One.", "Two.")))
    assert view.sentences.text() == "One.\nTwo."
    view.show_reading(reading())
    assert not view.sentences.isVisible()


def test_only_the_page_that_is_shown_takes_height_from_the_pictures(qtbot: QtBot) -> None:
    view = show_widget(qtbot, VideoView(), 760, 560)
    view.rows.rows.show()  # as with a frame
    heights = []
    for page in (0, 1, 0):
        view.pages.setCurrentIndex(page)
        QApplication.processEvents()
        heights.append(view.pictures.height())
    assert heights[1] + 100 < heights[0] == pytest.approx(heights[2], abs=2)
