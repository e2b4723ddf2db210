"""The exposure of the column that the mouse, a click, an arrow key or a number chooses."""

import pytest
from gui.kinds import show_widget
from gui.mouse import move_mouse
from gui.pane_bench import PaneBench
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QPalette
from pytestqt.qtbot import QtBot

from occ_gui.app.panes import equations, profile
from occ_gui.explanation.exposure_plot import ExposurePlot
from occ_gui.explanation.pane import ExplanationPane
from occ_gui.widgets.plot import Plot
from occ_model.scene.scene import Scene
from occ_model.teaching.light_over_columns import exposure_window


@pytest.fixture
def plot(qtbot: QtBot) -> ExposurePlot:
    return show_widget(qtbot, ExposurePlot(), 360, 200)


def test_chips_window_and_time_on_are_drawn_in_microseconds(
    plot: ExposurePlot, small_scene: Scene
) -> None:
    window = exposure_window(small_scene, 1003)
    plot.show_window(window, 42.25)
    x, y = plot.chips.getData()
    assert x == pytest.approx(window.edges * 1e6)
    assert y.tolist() == window.levels.tolist()
    low, high = plot.shade.getRegion()
    assert high - low == pytest.approx(68.0)
    parts = window.lit_parts * 1e6
    assert plot.lit.opts["x0"] == pytest.approx(parts[:, 0])
    assert plot.lit.opts["x1"] == pytest.approx(parts[:, 1])
    assert plot.lit.opts["brush"].style() == Qt.BrushStyle.BDiagPattern
    fraction = 100 * window.on_time / 68e-6
    text = (
        f"Column 1003: 68 µs exposure, LED on for {window.on_time * 1e6:.4g} µs ({fraction:.0f} %)"
    )
    assert plot.sentence.text() == f"{text} → 42.2 grey levels"
    first, last = plot.plot.getViewBox().viewRange()[0]
    assert first <= 0.0 < x[-1] <= last


def test_a_column_in_the_dark_has_no_time_on_and_what_is_not_drawn_is_named(
    plot: ExposurePlot, small_scene: Scene
) -> None:
    plot.show_window(exposure_window(small_scene.replace(pattern="0"), 5), 9.0)
    assert not plot.lit.isVisible()
    assert "LED on for 0 s (0 %)" in plot.sentence.text()
    scene = small_scene.replace(exposure_time=1.0)
    window = exposure_window(scene, 5)
    plot.show_window(window, 9.0)
    assert (
        f"only the first {len(window.levels)} changes of the light are drawn"
        in plot.sentence.text()
    )
    assert plot.shade.getRegion()[1] <= plot.chips.getData()[0][-1]


class Bench(PaneBench):
    """The equations beside the profile in which their column is chosen."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.plot = self.add(profile(self.store, self.results_store, str)).view.plot
        self.pane: ExplanationPane = self.add(equations(self.scenes, lambda: self.plot))
        self.view = self.pane.view.exposure
        self.simulate()

    @property
    def shown(self) -> tuple[int, bool]:
        """The column, and whether it is held."""
        return self.view.column.value(), self.view.hold.isChecked()


def place_of(plot: Plot, column: float) -> QPoint:
    scene = plot.getViewBox().mapViewToScene(QPointF(column, 20.0))
    return plot.mapFromScene(scene)


def move_to(plot: Plot, column: float) -> None:
    """Move the mouse over a column of the profile."""
    move_mouse(plot.viewport(), place_of(plot, column))


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Bench:
    return Bench(qtbot, small_scene)


def test_mouse_click_and_keys_over_the_profile_choose_a_column(bench: Bench, qtbot: QtBot) -> None:
    exposure, plot = bench.view, bench.plot
    viewport = plot.viewport()
    first, last = plot.getViewBox().viewRange()[0]
    pointed_at, clicked = (round(first + fraction * (last - first)) for fraction in (0.3, 0.6))
    move_to(plot, pointed_at)
    qtbot.waitUntil(lambda: abs(exposure.column.value() - pointed_at) <= 1)
    qtbot.mouseClick(viewport, Qt.MouseButton.LeftButton, pos=place_of(plot, clicked))
    qtbot.waitUntil(exposure.hold.isChecked)
    column = exposure.column.value()
    assert abs(column - clicked) <= 1
    qtbot.keyClick(plot, Qt.Key.Key_Right)
    assert exposure.column.value() == column + 1
    assert exposure.sentence.text().startswith(f"Column {column + 1}:")
    assert bench.pane.picker.marker.value() == column + 1
    qtbot.keyClick(plot, Qt.Key.Key_PageUp)
    assert exposure.column.value() == column + 11
    qtbot.keyClick(plot, Qt.Key.Key_PageDown)
    assert exposure.column.value() == column + 1
    qtbot.keyClick(plot, Qt.Key.Key_Escape)
    assert not exposure.hold.isChecked()


def test_a_number_typed_holds_a_column_which_is_marked_while_it_is_explained(
    bench: Bench, qtbot: QtBot
) -> None:
    exposure = bench.view
    exposure.column.selectAll()
    qtbot.keyClicks(exposure.column, "1100")
    qtbot.keyClick(exposure.column, Qt.Key.Key_Return)
    assert exposure.sentence.text().startswith("Column 1100:")
    assert exposure.hold.isChecked()
    qtbot.keyClick(exposure.hold, Qt.Key.Key_Space)
    bench.pane.exposure.hover(5)
    assert bench.shown == (5, False)
    # The profile's mark stays while the exposure is visible.
    marker, sentence = bench.pane.picker.marker, bench.view.sentence
    assert marker.isVisible()
    palette = bench.plot.palette()
    palette.setColor(QPalette.ColorRole.Text, QColor("red"))
    bench.plot.setPalette(palette)
    assert marker.pen.color() == QColor("red")
    bench.see("equations", False)
    assert not marker.isVisible()
    said = sentence.text()
    move_to(bench.plot, bench.plot.getViewBox().viewRange()[0][0] + 50.0)
    qtbot.keyClick(bench.plot, Qt.Key.Key_Right)
    assert sentence.text() == said


def test_the_exposure_follows_the_scene_and_no_column_outside_of_the_picture_is_shown(
    bench: Bench,
) -> None:
    exposure = bench.view
    levels = bench.simulate(exposure_time=136e-6).profile
    assert "136 µs exposure" in exposure.sentence.text()
    assert f"{levels[exposure.column.value()]:.1f} grey levels" in exposure.sentence.text()
    controller = bench.pane.exposure
    controller.hover(-5)
    assert bench.shown[0] == 0
    controller.hover(10**9)
    assert bench.shown[0] == len(bench.results_store.results.snapshot.profile) - 1
    bench.simulate(columns=500)
    assert bench.shown[0] == 499
    bench.see("equations", False)
    controller.hover(5)
    assert bench.shown[0] == 499, "nothing is computed while the pane is hidden"
    bench.see("equations")
    assert bench.shown[0] == 5


def test_a_held_column_stays_until_it_is_released(bench: Bench) -> None:
    controller = bench.pane.exposure
    controller.hover(10)
    controller.click(20)
    controller.hover(30)
    assert bench.shown == (20, True)
    controller.click(21)
    assert bench.shown == (21, True)
    controller.step(-3)
    assert bench.shown == (18, True)
    controller.click(18)
    assert bench.shown == (18, False)
    controller.hover(40)
    assert bench.shown == (40, False)
    controller.choose(50)
    controller.hold(False)
    controller.hover(60)
    assert bench.shown == (60, False)


def test_the_column_shown_first_is_in_the_panels_first_packet(
    qtbot: QtBot, small_scene: Scene
) -> None:
    bench = Bench(qtbot, small_scene.replace(panel_width=0.3))
    snapshot = bench.results_store.results.snapshot
    first, above = snapshot.panel_origin
    assert abs(first - above) > snapshot.period_columns
    assert first < bench.shown[0] < first + snapshot.period_columns
