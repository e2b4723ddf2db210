"""Two pinned scenes: differences are listed, both are drawn, and either can be restored."""

from dataclasses import replace

import numpy as np
import pytest
from gui.kinds import SnapshotOf, collect, show_widget
from gui.pane_bench import PaneBench
from gui.stores import store_of
from PySide6.QtWidgets import QTableWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.panes import compare
from occ_gui.pins.compare_view import CompareView
from occ_gui.pins.comparison import PinnedPair
from occ_gui.pins.pin_controller import PinController
from occ_gui.simulation.jobs import snapshot_of as snapshot_of_frame
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.widgets.columns import PACKETS_IN_VIEW
from occ_model.results.decoding import symptom
from occ_model.scene.scene import Scene


@pytest.fixture
def pins(qapp: object, small_scene: Scene) -> PinController:
    return PinController(store_of(small_scene))


def pin_two(pins: PinController, a: Snapshot, b: Snapshot) -> None:
    for name, snapshot in (("A", a), ("B", b)):
        pins.show_snapshot(snapshot)
        pins.pin(name)


def inputs(pinned: PinnedPair) -> dict[str, tuple[str, str]]:
    return {row.name: (row.a, row.b) for row in pinned.inputs}


def outputs(pinned: PinnedPair) -> dict[str, tuple[str, str]]:
    return {row.name: (row.a, row.b) for row in pinned.outputs}


def test_only_inputs_that_differ_are_listed_in_units_of_display_and_alike_ones_with_all_digits(
    pins: PinController, bare_snapshot_of: SnapshotOf
) -> None:
    pin_two(pins, bare_snapshot_of(), bare_snapshot_of(exposure_time=136e-6, distance=1.5))
    assert inputs(pins.pinned) == {
        "Exposure time": ("68 µs", "136 µs"),
        "Distance": ("1.2 m", "1.5 m"),
    }
    assert all("Allowed" in row.meaning for row in pins.pinned.inputs)
    pin_two(pins, bare_snapshot_of(), bare_snapshot_of(distance=1.2000000001))
    a, b = inputs(pins.pinned)["Distance"]
    assert a != b


def test_an_empty_pattern_and_another_tolerance_are_worded(
    pins: PinController, snapshot_of: SnapshotOf, bare_snapshot_of: SnapshotOf
) -> None:
    pin_two(pins, snapshot_of(), bare_snapshot_of(pattern="10"))
    found = inputs(pins.pinned)
    assert found["Raw chip pattern"] == ("none", "10")
    assert found["Tolerance"][1].startswith("inf")


def test_the_outputs_are_those_of_the_two_states(
    pins: PinController, bare_snapshot_of: SnapshotOf
) -> None:
    a, b = bare_snapshot_of(), bare_snapshot_of(exposure_time=136e-6, switching_frequency=16e3)
    pin_two(pins, a, b)
    found = outputs(pins.pinned)
    swings = tuple(f"{np.ptp(s.frame.profile):.1f} grey levels" for s in (a, b))
    assert found["Contrast"] == swings
    assert found["Columns per chip"] == ("12.50 columns", "7.81 columns")
    assert found["Exposure"] == ("0.680 chips", "2.176 chips")
    right, why = found["Decoder “threshold”"]
    assert right == "code 718, right"
    assert why.startswith("1.3 kHz above the null at 14.7 kHz. ")
    assert why.endswith(f" {symptom(b.results['threshold'].failure or '')}")
    assert "Effects simulated" not in found  # none in both
    assert all(row.meaning for row in pins.pinned.outputs)


def test_the_effects_named_are_those_that_the_plan_includes(
    pins: PinController, bare_snapshot_of: SnapshotOf, snapshot_of: SnapshotOf
) -> None:
    none, some = bare_snapshot_of(), snapshot_of()
    included = [d.label for d in some.frame.plan.decisions if d.included]
    assert 0 < len(included) < len(some.frame.plan.decisions)
    pin_two(pins, none, some)
    assert outputs(pins.pinned)["Effects simulated"] == ("none", ", ".join(included))


def test_a_decoder_that_read_only_one_of_them_is_compared_with_none(
    pins: PinController, bare_snapshot_of: SnapshotOf
) -> None:
    once = bare_snapshot_of()
    asked = replace(once.request, more_decoders=("sequence",))
    twice = snapshot_of_frame(asked, once.frame)
    for a, b, texts in ((once, twice, ("not read", "code 718, right")),
                        (twice, once, ("code 718, right", "not read"))):  # fmt: skip
        pin_two(pins, a, b)
        found = outputs(pins.pinned)
        assert found["Decoder “sequence”"] == texts
        assert "Decoder “threshold”" not in found  # the same in both


def test_the_same_state_twice_has_no_differing_inputs_and_a_pin_no_picture(
    pins: PinController, bare_snapshot_of: SnapshotOf
) -> None:
    snapshot = bare_snapshot_of()
    pin_two(pins, snapshot, snapshot)
    assert (pins.pinned.inputs, pins.pinned.outputs) == ((), ())
    assert not any(
        isinstance(value, np.ndarray) and value.ndim > 1
        for value in (getattr(pins.pinned.a, name) for name in pins.pinned.a.__slots__)
    )


def test_an_impossible_command_is_answered_with_a_sentence(pins: PinController) -> None:
    messages = collect(pins.status_message)
    pins.pin("A")
    pins.go_to("B")
    assert len(messages) == 2
    assert all(sentence.endswith(".") for sentence in messages)


@pytest.fixture
def view(qtbot: QtBot) -> CompareView:
    return show_widget(qtbot, CompareView(), 660, 260)


def texts(table: QTableWidget) -> list[list[str]]:
    rows = []
    for row in range(table.rowCount()):
        items = [table.item(row, column) for column in range(3)]
        rows.append([item.text() for item in items if item is not None])
    return rows


def test_the_view_requests_what_is_missing_then_lists_and_draws(
    view: CompareView, pins: PinController, bare_snapshot_of: SnapshotOf
) -> None:
    assert "press Pin A" in view.hint.text()
    assert not view.table.isVisible()
    assert not view.return_buttons["A"].isEnabled()
    pins.show_snapshot(bare_snapshot_of())
    pins.pin("A")
    view.show_pinned(pins.pinned)
    assert view.hint.text().startswith("A is pinned.")
    assert "press Pin B" in view.hint.text()
    assert view.return_buttons["A"].isEnabled()
    pins.show_snapshot(bare_snapshot_of(iso=200.0))
    pins.pin("B")
    view.show_pinned(pins.pinned)
    assert not view.hint.isVisible()
    listed = texts(view.table)
    assert listed[:2] == [["Inputs"], ["ISO speed", "100", "200"]]
    assert ["Outputs"] in listed
    assert "Allowed" in view.table.item(1, 0).toolTip()
    for name, pin in (("A", pins.pinned.a), ("B", pins.pinned.b)):
        assert np.array_equal(view.curves[name].getOriginalDataset()[1], pin.profile)
    view.show_pinned(PinnedPair())
    assert "press Pin A" in view.hint.text()
    assert not view.clear.isEnabled()
    assert all(curve.getOriginalDataset() == (None, None) for curve in view.curves.values())


@pytest.mark.parametrize("iso", [100.0, 1.0])
def test_the_plot_shows_the_first_packets_of_both_up_to_their_brightest_columns(
    view: CompareView, pins: PinController, bare_snapshot_of: SnapshotOf, iso: float
) -> None:
    dark = bare_snapshot_of(iso=iso)
    pin_two(pins, dark, bare_snapshot_of(switching_frequency=16e3, iso=2.0 * iso))
    view.show_pinned(pins.pinned)
    both = [pin for pin in (pins.pinned.a, pins.pinned.b) if pin is not None]
    (first, last), (low, high) = view.plot.getViewBox().viewRange()
    starts = [pin.first_column for pin in both]
    ends = [pin.first_column + PACKETS_IN_VIEW * pin.period_columns for pin in both]
    shown = min(max(ends), len(both[0].profile) - 1.0)
    assert first == pytest.approx(min(starts), abs=0.03 * shown)
    assert last == pytest.approx(shown, abs=0.03 * shown)
    brightest = max(float(pin.profile.max()) for pin in both)
    assert low <= 0.0
    assert brightest <= high <= 1.2 * max(brightest, 20.0)


class Bench(PaneBench):
    """The pane, and the pins that its entries set."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.pins = PinController(self.scenes, lambda shown: shown.scene == self.scenes.scene)
        self.pins.status_message.connect(self.said.append)
        self.called_first.append(self.pins.show_snapshot)
        self.view: CompareView = self.add(compare(self.pins)).view
        self.simulate()

    def choose(self, entry: str) -> None:
        self.window.actions_by_name[entry].trigger()


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Bench:
    return Bench(qtbot, small_scene)


def test_states_are_pinned_compared_once_the_pane_is_visible_and_restored_in_one_step(
    bench: Bench, small_scene: Scene
) -> None:
    bench.see("compare", False)
    bench.choose("pin_a")
    assert "as A" in bench.said[-1]
    assert "pin it as B" in bench.said[-1]
    bench.simulate(iso=200.0)
    bench.choose("pin_b")
    assert bench.view.table.rowCount() == 0
    bench.see("compare")
    assert ["ISO speed", "100", "200"] in texts(bench.view.table)
    box = bench.view.plot.getViewBox()
    box.setRange(xRange=(1100.0, 1200.0), padding=0)
    for visible in (False, True):
        bench.see("compare", visible)
    assert box.viewRange()[0] == [1100.0, 1200.0], "the user's zoom stays"
    steps = bench.scenes.undo_stack.count()
    bench.view.return_buttons["A"].click()
    assert bench.scenes.scene == small_scene
    assert bench.scenes.undo_stack.count() == steps + 1
    bench.scenes.undo_stack.undo()
    assert bench.scenes.scene.camera.iso == 200.0
    bench.view.clear.click()
    assert bench.pins.pinned.a is None


def test_effects_forced_by_hand_are_compared_and_returned_to(bench: Bench) -> None:
    bench.scenes.force("jpeg", True)
    bench.simulate()
    bench.choose("pin_a")
    bench.scenes.force("jpeg", None)
    bench.scenes.force("vignetting", False)
    bench.simulate()
    bench.choose("pin_b")
    forced = inputs(bench.pins.pinned)
    assert forced == {"Effects switched": ("JPEG switched on", "Vignetting switched off")}
    bench.choose("go_to_a")
    assert bench.settings.settings.force == {"jpeg": True}
    bench.scenes.undo_stack.undo()
    assert bench.settings.settings.force == {"vignetting": False}


def test_a_pin_waits_for_the_results_of_the_present_scene_if_it_has_a_picture(bench: Bench) -> None:
    bench.scenes.change(iso=200.0)
    bench.choose("pin_a")
    assert bench.pins.pinned.a is None
    assert bench.said[-1] == "A will be pinned as soon as this scene is computed."
    bench.simulate()
    assert bench.pins.pinned.a is not None
    assert bench.pins.pinned.a.scene.camera.iso == 200.0
    bench.pins.clear()
    bench.scenes.change(distance=0.1, yaw=1.2)
    bench.choose("pin_a")
    bench.pins.cancel_waiting()
    assert "no picture" in bench.said[-1]
    bench.scenes.undo_stack.undo()
    bench.simulate()
    assert bench.pins.pinned.a is None
