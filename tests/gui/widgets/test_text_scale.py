"""Labels in bold follow the application's size of text, unless they have one of their own."""

from collections.abc import Iterator

import pytest
from gui.kinds import show_widget
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from occ_gui.widgets.text_scale import emboldened


@pytest.fixture(autouse=True)
def same_font_after(qapp: QApplication) -> Iterator[None]:
    font = qapp.font()
    yield
    qapp.setFont(font)


def test_a_label_in_bold_alone_follows_the_applications_size(
    qtbot: QtBot, qapp: QApplication
) -> None:
    label, larger = (show_widget(qtbot, emboldened(QLabel(), factor)) for factor in (1.0, 1.25))
    usual = qapp.font().pointSizeF()
    assert larger.font().pointSizeF() == pytest.approx(1.25 * usual)
    font = qapp.font()
    font.setPointSizeF(2.0 * usual)
    qapp.setFont(font)
    qapp.processEvents()  # Qt tells its windows of another font by an event
    assert label.font().bold()
    assert label.font().pointSizeF() == pytest.approx(2.0 * usual)
