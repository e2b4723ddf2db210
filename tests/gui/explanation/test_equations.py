"""The equations with the present numbers, and the marks on terms that have just changed."""

import re

import pytest
from gui.kinds import show_widget
from gui.pane_bench import PaneBench
from gui.stores import store_of
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QFont
from pytestqt.qtbot import QtBot

from occ_gui.app.panes import equations as equations_pane, profile
from occ_gui.explanation import equation_text
from occ_gui.explanation.equation_controller import EquationController
from occ_gui.explanation.equation_text import EquationText
from occ_model.scene.scene import Scene
from occ_model.teaching.equations import equations

NOTHING: frozenset[str] = frozenset()


@pytest.fixture
def view(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> EquationText:
    monkeypatch.setattr(equation_text, "HIGHLIGHT_MS", 60)
    return show_widget(qtbot, EquationText(), 360, 400)


def marked(view: EquationText) -> list[str]:
    """Return the pieces of text that have a background, are bold and underlined."""
    found = []
    block = view.document().begin()
    while block.isValid():
        pieces = block.begin()
        while not pieces.atEnd():
            piece = pieces.fragment()
            style = piece.charFormat()
            if style.background().style() != Qt.BrushStyle.NoBrush:
                assert style.fontWeight() >= QFont.Weight.DemiBold
                assert style.fontUnderline()
                found.append(piece.text())
            pieces += 1
        block = block.next()
    return found


def test_symbols_numbers_and_results_are_all_there_indices_low_and_quantities_in_italics(
    view: EquationText, small_scene: Scene
) -> None:
    found = equations(small_scene)
    view.show_equations(found, NOTHING)
    text = view.toPlainText()
    for equation in found:
        assert equation.result in text
        for term in equation.numbers:
            assert re.sub("<.*?>", "", term.text) in text
    assert "= (100 µs − 68 µs) / 8 µs" in text  # noqa: RUF001 - a minus sign
    assert "(S t (Lv + EvR/π) / (K N2))1/γ" in text  # noqa: RUF001 - the equation's own letter
    assert "[equation (1)]" in text
    assert marked(view) == []
    html = view.toHtml()
    assert re.search(
        r"font-style:italic;[^>]*>t</span><span[^>]*vertical-align:sub;[^>]*>on<", html
    )
    assert re.search(r"font-weight:\d+;[^>]*>= 12\.5 columns<", html)


def test_what_depends_on_the_change_is_marked_for_a_moment(
    view: EquationText, small_scene: Scene, qtbot: QtBot
) -> None:
    view.show_equations(equations(small_scene), frozenset({"readout_time"}))
    pieces = "".join(marked(view))
    assert "8 µs" in pieces
    assert "68 µs" not in pieces
    assert "γ" not in pieces  # noqa: RUF001 - the equation's own letter
    view.show_equations(equations(small_scene), frozenset({"gamma"}))
    assert "1/2.22" in "".join(marked(view))
    assert "8 µs" not in "".join(marked(view))
    (fading,) = view.findChildren(QTimer)
    fading.setInterval(10)
    view.show_equations(equations(small_scene), frozenset({"gamma"}))
    qtbot.waitUntil(lambda: marked(view) == [])
    assert "1/2.22" in view.toPlainText()


def test_where_the_band_model_is_undefined_a_sentence_says_so(
    view: EquationText, small_scene: Scene
) -> None:
    view.show_equations(equations(small_scene.replace(exposure_time=200e-6)), NOTHING)
    assert view.toPlainText().count("\nundefined: the exposure is longer") == 1
    assert "= 200 µs / 8 µs\n= 25 columns" in view.toPlainText()


def test_equations_follow_the_scene_only_while_they_are_visible(small_scene: Scene) -> None:
    store, shown = store_of(small_scene), list[object]()
    controller = EquationController(store, lambda *what: shown.append(what))
    store.change(iso=200.0)
    assert shown == []
    controller.set_visible(True)
    assert shown == [(equations(store.scene), NOTHING)]
    store.change(iso=300.0, exposure_time=1e-4)
    assert shown[1:] == [(equations(store.scene), {"iso", "exposure_time"})]
    controller.set_visible(False)
    store.change(iso=400.0)
    controller.set_visible(True)
    assert shown[2:] == [(equations(store.scene), NOTHING)]
    controller.set_visible(False)
    controller.set_visible(True)
    assert len(shown) == 3


def test_a_change_arrives_in_the_equations_that_are_seen(qtbot: QtBot, small_scene: Scene) -> None:
    bench = PaneBench(qtbot, small_scene)
    plot = bench.add(profile(bench.store, bench.results_store, str)).view.plot
    text = bench.add(equations_pane(bench.scenes, lambda: plot), seen=False).view.equations
    bench.scenes.change(exposure_time=90e-6)
    assert "90 µs" not in text.toPlainText()
    bench.see("equations")
    assert "= 90 µs / 8 µs" in text.toPlainText()
    bench.scenes.change(exposure_time=136e-6)
    assert "136 µs" in marked(text)
