"""Photos are loaded outside the window's thread; the photo that was requested last stays."""

import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from gui.kinds import Grey
from gui.stores import store_of
from gui.user import PATIENCE_S
from PIL import Image
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.shell.results import ResultsStore
from occ_gui.values.choices import MatchChoice
from occ_model.photo.reading.load import Photo, load_photo


class Bench:
    """A controller with a mock view; the test decides when a photo is loaded."""

    def __init__(self, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
        self.shown: list[Photo | None] = []
        self.failures: list[str] = []
        self.begun = threading.Event()
        self.go_on = threading.Event()
        self.go_on.set()
        monkeypatch.setattr(occ, "load_photo", self._read)
        store = store_of().store
        self.controller = PhotoController(store, ResultsStore())
        self.controller.opened.connect(self.shown.append)
        self.controller.failed.connect(self.failures.append)
        self._load = load_photo
        self._qtbot = qtbot

    def _read(
        self, path: Path, scan_axis: str, *, channel: str, progress: Callable[[float], object]
    ) -> Photo:
        self.begun.set()
        assert self.go_on.wait(PATIENCE_S)
        return self._load(path, scan_axis, channel=channel, progress=progress)

    def wait_until_idle(self) -> None:
        self.go_on.set()
        self._qtbot.waitUntil(lambda: self.controller.loading.task.is_idle)

    def open(self, path: Path) -> None:
        self.controller.open(path)
        self.wait_until_idle()

    def open_and_hold(self, path: Path) -> None:
        """Ask for a photo and come back while it is being read."""
        self.begun.clear()
        self.go_on.clear()
        self.controller.open(path)
        assert self.begun.wait(PATIENCE_S)

    @property
    def image(self) -> Grey:
        return self.shown[-1].image


@pytest.fixture
def bench(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    bench = Bench(qtbot, monkeypatch)
    yield bench
    bench.go_on.set()
    bench.controller.loading.task.stop()


@pytest.fixture
def other_file(tmp_path: Path) -> Path:
    path = tmp_path / "other.png"
    Image.fromarray(np.full((8, 9), 5, dtype=np.uint8)).save(path)
    return path


def test_a_photo_is_read_shown_and_announced_with_progress_from_start_to_end(
    bench: Bench, photo_file: Path, stripes: Grey
) -> None:
    received: list[object] = []
    loading = bench.controller.loading
    loading.begun.connect(lambda: received.append("begun"))
    loading.task.reported.connect(received.append)
    loading.ended.connect(lambda: received.append("ended"))
    bench.open(photo_file)
    assert np.array_equal(bench.image, stripes)
    assert len(bench.shown) == 1
    assert bench.failures == []
    assert (received[0], received[1], received[-2], received[-1]) == ("begun", 0.0, 1.0, "ended")


def test_an_unreadable_photo_says_why_and_the_last_photo_stays(
    bench: Bench, photo_file: Path, tmp_path: Path
) -> None:
    bench.open(photo_file)
    form = MatchChoice("lamp")
    bench.controller.edit(
        lambda choice: replace(choice.with_certain("switching_frequency", 2e3), form=form)
    )
    damaged = tmp_path / "damaged.png"
    damaged.write_bytes(photo_file.read_bytes()[:60])
    for path in (damaged, tmp_path / "missing.png", tmp_path):
        bench.open(path)
        assert str(path) in bench.failures[-1]
        assert bench.failures[-1].endswith(".")
        choice = bench.controller.choice
        assert (choice.form, choice.certain) == (form, {"switching_frequency": 2e3})
    assert len(bench.failures) == 3
    assert len(bench.shown) == 1


def test_a_cancelled_reading_ends_and_the_last_photo_stays(
    bench: Bench, photo_file: Path, other_file: Path, stripes: Grey, qtbot: QtBot
) -> None:
    bench.open(photo_file)
    ended: list[bool] = []
    bench.controller.loading.ended.connect(lambda: ended.append(True))
    bench.open_and_hold(other_file)
    bench.controller.cancel()
    assert bench.controller.loading.task.is_idle
    assert ended == [True]
    bench.go_on.set()
    bench.controller.set_scan_axis("lines")
    bench.wait_until_idle()
    assert [photo.path for photo in bench.shown if photo] == [photo_file, photo_file]
    assert np.array_equal(bench.image, stripes.T)
    assert bench.failures == []


def test_the_scan_axis_applies_to_this_photo_and_the_next_and_opens_no_photo(
    bench: Bench, photo_file: Path, tmp_path: Path, stripes: Grey
) -> None:
    def set_scan_axis(axis: str) -> None:
        bench.controller.set_scan_axis(axis)
        bench.wait_until_idle()

    set_scan_axis("lines")
    assert bench.shown == []
    bench.open(photo_file)
    assert np.array_equal(bench.image, stripes.T)
    for axis, expected in (("columns", stripes), ("auto", stripes), ("lines", stripes.T)):
        set_scan_axis(axis)
        assert np.array_equal(bench.image, expected)
    bench.open(tmp_path / "missing.png")  # after a failure the photo that is kept is turned
    set_scan_axis("columns")
    assert np.array_equal(bench.image, stripes)
    assert len(bench.failures) == 1
    bench.controller.close()
    set_scan_axis("lines")
    assert bench.shown[-1] is None


def test_another_channel_applies_to_this_photo_and_the_next(
    bench: Bench, tmp_path: Path, photo_file: Path
) -> None:
    coloured_file = tmp_path / "coloured.png"
    Image.fromarray(np.full((8, 9, 3), (10, 20, 30), dtype=np.uint8)).save(coloured_file)
    bench.open(coloured_file)
    assert bench.image.max() == 30
    bench.controller.set_channel("green")
    bench.wait_until_idle()
    assert bench.image.max() == 20
    bench.open(photo_file)
    bench.open(coloured_file)
    assert bench.image.max() == 20


def test_opening_a_file_again_reads_it_again_but_restoring_its_former_choice_does_not(
    bench: Bench, photo_file: Path, other_file: Path
) -> None:
    """A lesson restores the choice at its end."""
    bench.open(photo_file)
    first, choice = bench.shown[-1], bench.controller.choice
    Image.fromarray(np.full((8, 9), 5, dtype=np.uint8)).save(photo_file)
    bench.open(photo_file)
    assert bench.image.shape == (8, 9)
    bench.open(other_file)
    bench.begun.clear()
    bench.controller.edit(lambda _present: choice)
    assert bench.shown[-1] is first
    assert not bench.begun.is_set()
