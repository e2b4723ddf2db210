"""A whole application, pictures of widgets, and results to show, for the tests of the window."""

import gc
import math
import pickle
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Future
from itertools import count
from pathlib import Path
from threading import Event
from typing import Any, ClassVar

import numpy as np
import pytest
from gui.kinds import Grey, GreyPicture, SnapshotOf, simulate_once
from gui.shared_window import SharedWindow, end, new_window
from gui.starts import Starts
from gui.user import PatientQtBot, User
from PIL import Image
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.app.garbage_collection import return_freed_memory
from occ_gui.detection_map import wiring
from occ_gui.simulation import controller
from occ_model.parallel.job import Job, JobResult, do_job
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.render import render_with


class InlineWorkers:
    """Workers in this process, which do a job as soon as they are given it."""

    count = 2
    lost_by: tuple[type[Exception], ...] = (BrokenExecutor,)

    def __init__(self) -> None:
        self.jobs: list[Job] = []
        self.closed = self.renewed = 0

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        self.jobs.append(job)
        future: Future[JobResult] = Future()
        try:
            future.set_result(self.result(job))
        except Exception as error:  # noqa: BLE001 - as an executor does
            future.set_exception(error)
        return future

    def result(self, job: Job) -> JobResult:
        return do_job(job, lambda: None)

    def abandon(self, channel: int, run: int) -> None:
        pass

    def count_heartbeats(self, counter: int) -> int:
        return 0

    def renew(self) -> None:
        self.renewed += 1

    def close(self) -> None:
        self.closed += 1


class RememberingWorkers(InlineWorkers):
    """Workers that keep their results, as most tests of a pane begin with the same jobs."""

    _done: ClassVar[dict[bytes, JobResult]] = {}

    def result(self, job: Job) -> JobResult:
        asked = pickle.dumps((job.function, job.arguments))
        if asked not in self._done:
            self._done[asked] = super().result(job)
        return self._done[asked]


class LazyWorkers(InlineWorkers):
    """Workers that do nothing, at once, and keep no jobs."""

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        future = super().submit(job, channel, run)
        self.jobs.clear()
        return future

    def result(self, job: Job) -> JobResult:
        return JobResult(is_abandoned=True)


_FILES_DONE = count()


@pytest.fixture
def qtbot(qapp: QApplication, request: pytest.FixtureRequest) -> QtBot:
    """Drive widgets, and wait for them on a busy machine too."""
    return PatientQtBot(request)


@pytest.fixture(autouse=True)
def garbage_is_collected_on_this_thread() -> Iterator[None]:
    """Collect garbage here, since a worker that destroyed an old widget would block for ever."""
    gc.disable()
    yield
    gc.collect(1)
    gc.enable()


@pytest.fixture(scope="module", autouse=True)
def memory_is_given_back() -> Iterator[None]:
    """Free the memory of earlier tests, mostly pictures, after every fourth file."""
    yield
    # It takes a tenth of a second: after every file, 2 % of the time of all tests.
    if next(_FILES_DONE) % 4:
        return
    # Those of a test that ran no event loop wait for one.
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
    gc.collect()
    return_freed_memory()


@pytest.fixture(autouse=True)
def lazy_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Run no background measurements unless a test asks for them."""
    monkeypatch.setattr(wiring, "new_workers", LazyWorkers)


@pytest.fixture
def inline_workers() -> InlineWorkers:
    return InlineWorkers()


@pytest.fixture
def small_scene() -> Scene:
    """Return a scene that is simulated in a few milliseconds and whose code is read."""
    return occ.load_preset("phone-68us").replace(rows=200)


@pytest.fixture
def snapshot_of(small_scene: Scene) -> SnapshotOf:
    """Simulate the small scene with some parameters changed."""
    return lambda **changes: simulate_once(small_scene.replace(**changes))


@pytest.fixture
def bare_snapshot_of(small_scene: Scene) -> SnapshotOf:
    """Simulate the small scene as above, without any effect."""
    bare = SimulationSettings(tolerance=math.inf)
    return lambda **changes: simulate_once(small_scene.replace(**changes), bare)


@pytest.fixture(scope="session")
def starts() -> Iterator[Starts]:
    starts = Starts()
    yield starts
    starts.close()


@pytest.fixture(scope="session")
def kept_window() -> Iterator[SharedWindow]:
    """Keep a window for the tests of this process."""
    shared = SharedWindow()
    yield shared
    shared.close()


@pytest.fixture
def application(
    request: pytest.FixtureRequest, qtbot: QtBot, small_scene: Scene, kept_window: SharedWindow
) -> Iterator[Application]:
    """Show a whole application that has come to rest, and see that nothing of it is left behind."""
    if not request.node.get_closest_marker("own_window"):
        with kept_window.lent(qtbot, small_scene) as application:
            yield application
        return
    before = QApplication.topLevelWidgets()
    application = new_window(qtbot, small_scene)
    yield application
    end(application, before)


@pytest.fixture
def user(qtbot: QtBot, application: Application) -> User:
    return User(qtbot, application)


@pytest.fixture(scope="module")
def found() -> dict[tuple[object, ...], Match]:
    """Keep what was found in photos by the tests of a file."""
    return {}


@pytest.fixture
def remembered_matches(
    found: dict[tuple[object, ...], Match], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Match each photo once, and give its match to all tests that begin with one."""
    find = occ.match_photo

    def remembered(photo: Photo, scene: Scene, **how: Any) -> Match:
        known = [how[name] for name in sorted(how) if name != "progress"]
        asked = (photo.samples.tobytes(), scene, *known)
        if asked not in found:
            found[asked] = find(photo, scene, **how)
        return found[asked]

    monkeypatch.setattr(occ, "match_photo", remembered)


@pytest.fixture
def grey_picture() -> GreyPicture:
    """Take the picture of a widget in grey levels, shape (height, width)."""

    def take(widget: QWidget) -> Grey:
        image = widget.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
        rows = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(image.height(), -1)
        return rows[:, : image.width()].copy()

    return take


@pytest.fixture
def stripes() -> Grey:
    """Draw upright stripes, shape (60, 100): a photo whose columns were scanned."""
    columns = np.where(np.arange(100) % 20 < 10, 40, 200).astype(np.uint8)
    return np.tile(columns, (60, 1))


@pytest.fixture
def photo_file(tmp_path: Path, stripes: Grey) -> Path:
    path = tmp_path / "stripes.png"
    Image.fromarray(stripes).save(path)
    return path


@pytest.fixture
def photo(photo_file: Path) -> Photo:
    return occ.load_photo(photo_file)


@pytest.fixture
def release(monkeypatch: pytest.MonkeyPatch) -> Iterator[Event]:
    """Simulate no picture before the test sets this event."""
    may_end = Event()

    def wait_and_render(*arguments: Any, **named: Any) -> Any:
        may_end.wait()
        return render_with(*arguments, **named)

    monkeypatch.setattr(controller, "render_with", wait_and_render)
    yield may_end
    may_end.set()
