"""All text is made larger and normal again, at once, and stays so at the next start."""

from collections.abc import Iterator

import pytest
from gui.user import User
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.window.text_size import SIZES


@pytest.fixture(autouse=True)
def normal_again(application: Application) -> Iterator[None]:
    yield
    application.options.text_size.normal()


def sizes(application: Application) -> list[float]:
    bar, scene = application.story.verdict, application.controls
    shown = (
        bar.title, bar.sentence, scene.panels["Main"].labels["distance"], scene.preset,
        scene.code.bits, application.view("decode").verdict, application.view("accuracy").table,
    )  # fmt: skip
    QApplication.processEvents()  # Qt tells its windows of another font by an event
    return [widget.font().pointSizeF() for widget in shown]


def test_every_text_grows_alike_and_comes_back(application: Application, user: User) -> None:
    before, system = sizes(application), QApplication.font().pointSizeF()
    user.choose("Lar&ger text")
    user.choose("Lar&ger text")
    factor = SIZES[-1] / SIZES[0]
    assert QApplication.font().pointSizeF() == pytest.approx(factor * system)
    assert sizes(application) == pytest.approx([factor * size for size in before])
    user.choose("Lar&ger text")  # there is none larger
    assert sizes(application) == pytest.approx([factor * size for size in before])
    made_later = QLabel("new")
    assert made_later.font().pointSizeF() == pytest.approx(factor * system)
    user.choose("Smaller te&xt")
    user.choose("&Normal text size")
    assert sizes(application) == pytest.approx(before)


def test_the_size_is_kept_for_the_next_start(application: Application, user: User) -> None:
    user.choose("Lar&ger text")
    kept = application.preferences.recall("view/text_percent")
    assert kept == str(SIZES[1])
    assert user.message == f"Text at {SIZES[1]} %"


@pytest.mark.parametrize("percent", SIZES)
def test_larger_text_is_not_cut_in_bars_and_buttons(
    application: Application, user: User, qtbot: QtBot, percent: int
) -> None:
    window = application.window
    window.resize(1280, 800)
    application.options.text_size.choose(percent)
    user.wait_until_idle()
    story, bar = application.story, application.story.verdict
    legend, buttons = story.rows.legend, [story.whole, *story.rows.ranges.values()]
    qtbot.waitUntil(lambda: bar.title.text() == bar.heading)
    qtbot.waitUntil(lambda: all(b.width() >= b.minimumSizeHint().width() for b in buttons))
    qtbot.waitUntil(lambda: all(b.height() >= b.minimumSizeHint().height() for b in buttons))
    qtbot.waitUntil(lambda: legend.height() >= legend.heightForWidth(legend.width()))
    assert (window.size().width(), window.size().height()) == (1280, 800)
