"""A pane is declared to the window, and made when it is first shown."""

from collections.abc import Iterator
from dataclasses import replace

import pytest
from gui.kinds import SnapshotOf
from gui.pane_bench import PlainWindow
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import ResultsStore
from occ_gui.shell.shell import Shell
from occ_model.scene.scene import Scene


class RecordingPane(Pane[object]):
    """A pane that records what it is asked to show."""

    def __init__(self) -> None:
        super().__init__(QLabel())
        self.parts: list[object] = []
        self.visibilities: list[bool] = []
        self.is_busy = self.is_stopped = False

    def show_part(self, part: object) -> None:
        self.parts.append(part)

    def set_visible(self, visible: bool) -> None:
        self.visibilities.append(visible)

    @property
    def is_idle(self) -> bool:
        return not self.is_busy

    def stop(self) -> None:
        self.is_stopped = True


class Bench:
    """A shell with a pane of the ISO speed."""

    def __init__(self, qtbot: QtBot) -> None:
        self.store, self.window = Store(Workspace(Scene())), PlainWindow()
        self.results_store = ResultsStore()
        qtbot.addWidget(self.window)
        self.shell = Shell(self.store, self.results_store)
        self.done: list[str] = []
        self.shell.add(
            Feature(
                name="iso",
                title="ISO speed",
                help="guide.md#iso",
                make=RecordingPane,
                part=lambda workspace, results: (workspace.scene.camera.iso, results.snapshot),
                actions={"do": lambda: self.done.append("done")},
            ),
            self.window,
        )

    def see(self, seen: bool) -> None:
        self.window.docks["iso"].visibilityChanged.emit(seen)

    def put(self, iso: float) -> None:
        scene = self.store.workspace.scene.replace(iso=iso)
        self.store.put(replace(self.store.workspace, scene=scene))

    @property
    def pane(self) -> RecordingPane:
        pane = self.shell.find_pane("iso")
        assert isinstance(pane, RecordingPane)
        return pane


@pytest.fixture
def bench(qtbot: QtBot) -> Iterator[Bench]:
    bench = Bench(qtbot)
    yield bench
    bench.shell.stop()


def test_a_pane_is_made_when_it_is_first_shown(bench: Bench) -> None:
    bench.see(False)
    bench.put(200.0)
    assert bench.shell.find_pane("iso") is None
    assert bench.shell.is_idle
    bench.see(True)
    pane = bench.pane
    assert pane.widget.parentWidget() is bench.window.docks["iso"].widget()
    assert pane.parts == [(200.0, None)]
    assert bench.shell.pane("iso") is pane


def test_a_visible_pane_follows_only_its_part(bench: Bench, snapshot_of: SnapshotOf) -> None:
    bench.see(True)
    bench.put(200.0)
    bench.store.put(replace(bench.store.workspace, frame_rate=24.0))
    snapshot = snapshot_of()
    bench.results_store.show_snapshot(snapshot)
    assert bench.pane.parts[1:] == [(200.0, None), (200.0, snapshot)]


def test_a_hidden_pane_is_updated_when_it_is_shown_again(bench: Bench) -> None:
    bench.see(True)
    bench.see(False)
    bench.put(200.0)
    bench.put(300.0)
    assert len(bench.pane.parts) == 1
    bench.see(True)
    assert bench.pane.parts[1:] == [(300.0, None)]
    assert bench.pane.visibilities == [True, False, True]


def test_a_pane_is_not_asked_to_show_none(qtbot: QtBot) -> None:
    window, results_store = PlainWindow(), ResultsStore()
    qtbot.addWidget(window)
    shell = Shell(Store(Workspace(Scene())), results_store)
    shell.add(
        Feature(name="x", title="x", help="", make=RecordingPane, part=lambda _, r: r.snapshot),
        window,
    )
    window.docks["x"].visibilityChanged.emit(True)
    results_store.changed.emit()
    assert shell.pane("x").parts == []


def test_a_panes_menu_entry_help_page_work_and_end_are_passed_on(bench: Bench) -> None:
    bench.window.actions_by_name["do"].trigger()
    assert bench.done == ["done"]
    assert bench.shell.help_pages == {"iso": "guide.md#iso"}
    bench.see(True)
    bench.pane.is_busy = True
    assert not bench.shell.is_idle
    bench.pane.is_busy = False
    assert bench.shell.is_idle
    bench.shell.stop()
    assert bench.pane.is_stopped


def test_a_pane_about_codes_is_away_while_another_light_is_sent(qtbot: QtBot) -> None:
    store, window = Store(Workspace(Scene().replace(light="lamp"))), PlainWindow()
    qtbot.addWidget(window)
    shell = Shell(store, ResultsStore())
    feature = Feature(
        name="x", title="Map", make=RecordingPane, part=lambda w, _: w.scene, is_about_codes=True
    )
    shell.add(feature, window)

    def send(light: str) -> None:
        store.put(replace(store.workspace, scene=store.workspace.scene.replace(light=light)))

    window.docks["x"].visibilityChanged.emit(True)
    assert shell.find_pane("x") is None
    (note,) = window.docks["x"].widget().findChildren(QLabel)
    assert "lamp of 1 kHz" in note.text()
    assert not note.isHidden()
    send("code")
    pane = shell.pane("x")
    assert (note.isHidden(), pane.widget.isHidden()) == (True, False)
    assert (pane.visibilities, len(pane.parts)) == ([True], 1)
    send("mains")
    assert (note.isHidden(), pane.widget.isHidden()) == (False, True)
    assert (pane.visibilities, len(pane.parts)) == ([True, False], 1)
    send("code")
    assert pane.visibilities == [True, False, True]
    shell.stop()
