"""Results of an earlier scene are marked, and its verdict is never shown as the present one's."""

from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from gui.kinds import SnapshotOf
from gui.user import User
from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.background.result_age import PAUSE, ResultAges
from occ_gui.shell.feature import Pane
from occ_gui.shell.outdated_marks import VERDICT_DELAY, OutdatedMarks
from occ_gui.shell.results import ResultsStore, of_picture, of_reading, of_snapshot
from occ_gui.simulation.snapshot import Picture, Snapshot
from occ_gui.values.simulated import SimulationRequest
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_model.receiver.decode import DECODERS, QUICK_DECODERS
from occ_model.scene.scene import Scene

RIGHT = "✓ Code 718 read, all bits right"


def marks(application: Application) -> list[QWidget]:
    return [*application.outdated.find_marks()]


def tabs(application: Application) -> list[str]:
    bar = application.view("decode").decoders
    texts = {name: bar.tabText(place) for place, name in enumerate(DECODERS)}
    return [texts[name].split()[-1] for name in QUICK_DECODERS]


def test_a_verdict_does_not_wait_for_the_picture(
    application: Application, user: User, release: Event, qtbot: QtBot
) -> None:
    decode = application.view("decode")
    assert (decode.verdict.text(), tabs(application)) == (RIGHT, ["✓", "✓"])
    application.scene_store.change(switching_frequency=500.0)
    qtbot.waitUntil(lambda: decode.verdict.text() == "✗ No code read")
    assert tabs(application) == ["✗", "✗"]
    assert decode.origin.text() == "Read from the column profile; the picture follows."
    reading = application.view("profile").reading
    assert reading.scene == application.scene_store.scene
    release.set()
    user.wait_until_idle()
    assert decode.verdict.text() == "✗ No code read"
    assert decode.origin.text() == "Read from the picture."


@pytest.mark.own_window  # only panes that have been made are marked
@pytest.mark.parametrize("jpeg", [pytest.param(0, marks=pytest.mark.whole), 60])
def test_each_pane_is_marked_while_its_result_is_outdated(
    application: Application, user: User, release: Event, qtbot: QtBot, jpeg: int
) -> None:
    for name in ("picture", "profile", "decode", "accuracy"):
        application.view(name)
    application.window.bring_to_front("equations")
    application.shell.pane("equations").set_visible(True)
    assert {mark.parentWidget() for mark in marks(application)} == {
        application.story.rows.stripes,
        application.view("picture").simulation,
        application.story.rows,
        application.view("profile"),
        application.view("decode"),
        *application.view("accuracy").scene_parts,
        application.shell.pane("equations").view.exposure,
    }
    assert all(mark.isHidden() for mark in marks(application))
    application.scene_store.change(iso=60.0, jpeg_quality=jpeg)
    outdated = application.outdated
    late = outdated.find_marks(of_picture, of_snapshot, *((of_reading,) if jpeg else ()))
    # On a busy machine the reading may be late, too, and is marked until then.
    qtbot.waitUntil(lambda: all(mark.isHidden() != (mark in late) for mark in marks(application)))
    assert {mark.accessibleName() for mark in late} == {"computing…"}
    release.set()
    user.wait_until_idle()
    assert all(mark.isHidden() for mark in marks(application))


def test_after_a_refusal_the_last_picture_is_marked_as_older(
    application: Application, user: User, qtbot: QtBot, small_scene: Scene
) -> None:
    frame = application.view("picture").frame
    user.change(distance=0.1, yaw=1.2)
    qtbot.waitUntil(lambda: not any(mark.isHidden() for mark in marks(application)[:5]))
    assert application.view("picture").frame is frame
    assert application.story.verdict.title.text() == "No picture of this scene"
    earlier = f"Earlier scene: {RIGHT}"
    strip = application.view("decode").strip
    qtbot.waitUntil(lambda: application.view("decode").verdict.text() == earlier)
    assert strip.accessibleDescription().startswith("earlier scene: sent ")
    text = "of an earlier scene: this one has no picture"
    assert {mark.accessibleName() for mark in marks(application)} == {text}
    application.scene_store.undo_stack.undo()
    assert application.scene_store.scene == small_scene
    user.wait_until_idle()
    assert application.view("decode").verdict.text() == RIGHT
    assert strip.accessibleDescription().startswith("sent ")
    assert application.story.verdict.title.text() in RIGHT
    assert all(mark.isHidden() for mark in marks(application))


class Simulation(QObject):
    """A simulation whose results the test delivers, at times that it sets."""

    submitted = Signal()
    failed = Signal(str)

    def __init__(self, first: Snapshot) -> None:
        super().__init__()
        self.now, self.results_store = 0.0, ResultsStore()
        self.ages = ResultAges(first.request, lambda: self.now)

    def change(self, snapshot: Snapshot) -> None:
        self.ages.begin(snapshot.request)
        self.submitted.emit()

    def deliver(self, snapshot: Snapshot) -> None:
        self.results_store.show_picture(Picture(snapshot.frame, snapshot.request))
        self.results_store.show_snapshot(snapshot)
        self.results_store.show_reading(snapshot)


class VerdictRecorder:
    """A pane that records whether its verdict is outdated, and the values of a run."""

    def __init__(self) -> None:
        self.outdated: list[bool] = []
        self.runs: list[tuple[str, str]] = []

    def show_outdated(self, outdated: bool) -> None:
        self.outdated.append(outdated)

    def show_run(self, value: str, pictured: str) -> None:
        self.runs.append((value, pictured))


class Drag:
    """A slider that moves every 16 ms while each picture takes some time."""

    def __init__(self, qtbot: QtBot, snapshot_of: SnapshotOf) -> None:
        self.pane = pane = QWidget()
        qtbot.addWidget(pane)
        first = snapshot_of()
        scene, settings = first.request.scene, first.request.settings
        self.snapshots = [
            replace(first, request=SimulationRequest(scene.replace(iso=iso), settings))
            for iso in np.geomspace(50.0, 200.0, 61).tolist()
        ]
        self.latest = self.snapshots[0]
        self.simulation, self.verdict = Simulation(self.latest), VerdictRecorder()
        results_store = self.simulation.results_store
        self.outdated = OutdatedMarks(results_store, self.simulation, pane)  # type: ignore[arg-type]
        marked: Pane[None] = Pane(pane)
        marked.made_of, marked.verdicts = {pane: of_snapshot}, (self.verdict,)
        self.outdated.mark_pane("pane", marked)
        self.outdated.mark(pane, of_picture)
        self.simulation.deliver(self.snapshots[0])

    def move(
        self, takes: int, milliseconds: int = 960, of: OutdatedMark | None = None
    ) -> list[bool]:
        """Move the slider, and return for each millisecond whether the mark was visible.

        Each picture takes so many milliseconds, during which only the newest move waits.
        """
        marked: list[bool] = []
        at_work: tuple[Snapshot, int] | None = None
        waiting: Snapshot | None = None
        for tick in range(milliseconds):
            self.simulation.now = 1e-3 * tick
            if tick % 16 == 0:
                waiting = self.latest = self.snapshots[tick // 16 + 1]
                self.simulation.change(waiting)
            if at_work is not None and tick >= at_work[1]:
                self.simulation.deliver(at_work[0])
                at_work = None
            if at_work is None and waiting is not None:
                at_work, waiting = (waiting, tick + takes), None
            marked.append(not (of or self.outdated.find_marks(of_snapshot)[0]).isHidden())
        return marked


@pytest.fixture
def drag(qtbot: QtBot, snapshot_of: SnapshotOf) -> Drag:
    return Drag(qtbot, snapshot_of)


def test_a_drag_with_fast_pictures_is_never_marked(drag: Drag) -> None:
    assert not any(drag.move(takes=14))
    assert set(drag.verdict.outdated) == {False}


def test_a_drag_with_slow_pictures_is_marked_without_flicker(drag: Drag) -> None:
    marked = drag.move(takes=round(3e3 * DELAY))
    first = marked.index(True)
    assert all(marked[first:])


def test_a_slow_verdict_is_outdated_without_flicker_until_after_the_drag(
    drag: Drag, qtbot: QtBot
) -> None:
    drag.move(takes=round(3e3 * VERDICT_DELAY))
    first = drag.verdict.outdated.index(True)
    assert set(drag.verdict.outdated[first:]) == {True}
    drag.simulation.deliver(drag.latest)
    drag.simulation.now += 2 * PAUSE
    qtbot.waitUntil(lambda: not drag.verdict.outdated[-1])


def test_a_run_with_slow_pictures_marks_no_picture_and_states_its_value(drag: Drag) -> None:
    (picture,) = drag.outdated.find_marks(of_picture)
    drag.outdated.follow_run("iso")
    marked = drag.move(takes=round(3e3 * DELAY), of=picture)
    assert not any(marked)
    marked = drag.move(takes=round(3e3 * DELAY))
    assert set(drag.verdict.outdated) == {False}
    first = marked.index(True)
    assert all(marked[first:])  # results without a verdict are marked without flicker
    assert all(drag.move(takes=14))  # even if they arrive soon
    drag.move(takes=round(3e3 * DELAY))
    reading = of_reading(drag.simulation.results_store.results)
    assert drag.verdict.runs[-1] == (f"ISO speed {reading.scene.camera.iso:.4g}", "")
    drag.outdated.follow_run("")
    assert drag.verdict.runs[-1] == ("", "")
    drag.simulation.now += DELAY
    drag.simulation.submitted.emit()
    assert not picture.isHidden()


def test_a_picture_older_than_the_reading_of_a_run_has_its_own_value(drag: Drag) -> None:
    drag.outdated.follow_run("iso")
    later = drag.snapshots[9]
    drag.simulation.change(later)
    drag.simulation.results_store.show_reading(later)
    before, after = (s.request.scene.camera.iso for s in (drag.snapshots[0], later))
    assert drag.verdict.runs[-1] == (f"ISO speed {after:.4g}", f"{before:.4g}")
