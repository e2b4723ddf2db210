"""Controller of the film: opens it, plays it, and shows its frames beside simulated ones."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal

import occ_model as occ
from occ_gui.background.task import Report, Task
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import ResultsStore, ResultUpdater
from occ_gui.values.choices import FilmChoice, FilmSource
from occ_gui.video.frame_jobs import FrameRequest, ShownFrame, process_frame
from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.results.video import USUAL_RATE, Video, VideoFrame

_INTERVAL_MS = 33  # least milliseconds between two frames on the screen

_DRAFT_STEP = 8  # while a film plays, a draft simulates one of this many rows


class FilmPlayer(QObject):
    """Plays a film at its own speed, skipping frames that would be late."""

    frame_requested = Signal(int)  # the index of the frame to show

    playing_changed = Signal(bool)

    def __init__(self, parent: QObject | None = None, clock: QElapsedTimer | None = None) -> None:
        super().__init__(parent)
        self.index = 0  # index of the frame that is shown or requested
        self.count = 0  # number of frames, as far as it is known
        self._rate = USUAL_RATE
        self._start_index = 0
        self._clock = clock or QElapsedTimer()
        self._timer = QTimer(self)
        self._timer.setInterval(_INTERVAL_MS)
        self._timer.timeout.connect(self.advance)

    @property
    def is_playing(self) -> bool:
        return self._timer.isActive()

    def set_film(self, count: int, rate: float | None) -> None:
        """Stop, and take another film with this number of frames and frame rate."""
        self.pause()
        self.index, self.count = 0, count
        self._rate = rate or USUAL_RATE

    def set_count(self, count: int) -> None:
        """Set the number of frames once reading the film has found it."""
        self.count = count
        if self.index >= count > 0:
            self.seek(count - 1)

    def toggle(self) -> None:
        if self.is_playing:
            self.pause()
        else:
            self.play()

    def play(self) -> None:
        if self.count < 2 or self.is_playing:
            return
        if self.index >= self.count - 1:
            self._show(0)
        self._start_index = self.index
        self._clock.start()
        self._timer.start()
        self.playing_changed.emit(True)

    def pause(self) -> None:
        if self.is_playing:
            self._timer.stop()
            self.playing_changed.emit(False)

    def seek(self, index: int) -> None:
        index = min(max(index, 0), max(self.count - 1, 0))
        self._start_index = index
        self._clock.start()
        if self.count and index != self.index:
            self._show(index)

    def step(self, frames: int) -> None:
        self.pause()
        self.seek(self.index + frames)

    def advance(self) -> None:
        seconds = 1e-3 * self._clock.elapsed()
        index = min(self._start_index + int(seconds * self._rate), self.count - 1)
        if index > self.index:
            self._show(index)
        if self.index >= self.count - 1:
            self.pause()

    def _show(self, index: int) -> None:
        self.index = index
        self.frame_requested.emit(index)


def _open(source: FilmSource, report: Report) -> Video:
    report(0.0)
    return occ.load_video(source.path, source.axis)


class FilmController(QObject):
    """The open film, the frame of it that is shown, and the simulated film beside it."""

    opened = Signal(object)  # the open Video; None for the simulated film

    failed = Signal(str)  # why a film cannot be opened; the open film stays

    frame_shown = Signal(object)

    frame_failed = Signal(str)  # why a frame cannot be shown; the last one stays

    def __init__(self, scenes: SceneStore, results_store: ResultsStore) -> None:
        super().__init__()
        self._scenes, self._store = scenes, scenes.store
        self._shown_choice = replace(self.choice, path=None)
        """The choices for the film that is shown; those for a film that is still loading differ."""
        self.film: Video | None = None  # the open film; None for the simulated film
        self.is_live = False  # whether the film comes from a camera, which keeps no frames
        self.live_frame: VideoFrame | None = None
        """The last frame of a camera; it stays when the camera is gone."""
        self._is_visible = False
        self.player = FilmPlayer(self)
        self.player.frame_requested.connect(self.show)
        self.opener = ResultUpdater(
            scenes.store, results_store, Task(_open, "opening of the film", impatient=True),
            lambda workspace, _: workspace.film.source,
            lambda results, film: replace(results, film=film), stays=True, keep=1,
        )  # fmt: skip
        self.opener.failed.connect(self._fail)
        results_store.select(lambda results: results.film).changed.connect(self._settle)
        self.loader: Task[FrameRequest, ShownFrame] = Task(
            lambda request, _: process_frame(request), "reading of a frame"
        )
        self.loader.finished.connect(self.frame_shown)
        self.loader.failed.connect(self.frame_failed)
        # Connected last: when the film stops, the exact picture replaces the draft.
        self.player.playing_changed.connect(self._on_playing)
        for store in (scenes, scenes.settings):
            store.changed.connect(self.show)

    @property
    def choice(self) -> FilmChoice:
        return self._store.workspace.film

    @property
    def count(self) -> int:
        """Number of frames; 0 if it is unknown."""
        if self.film is None:
            return self.choice.frames
        return self.film.frame_count or 0

    @property
    def rate(self) -> float | None:
        return self.choice.recording.frame_rate if self.film is None else self.film.frame_rate

    def simulate(self) -> Video:
        """Simulate a film of the present scene; raises OccError if it cannot be recorded."""
        return occ.render_video(
            self._scenes.seen, self.choice.frames, self.choice.recording,
            settings=self._scenes.settings.settings,
        )  # fmt: skip

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        if visible:
            self.show()
        else:
            self.player.pause()

    def open(self, path: Path, axis: str = SCAN_AXES[0]) -> None:
        """Open a film along one of SCAN_AXES; the present film stays until the new one is ready."""
        self.edit(lambda choice: choice.open(path, axis))

    def edit(self, change: Callable[[FilmChoice], FilmChoice]) -> None:
        if self.opener.task.is_idle:
            self._shown_choice = self.choice
        workspace = self._store.workspace
        self._store.put(replace(workspace, film=change(workspace.film)))

    def _settle(self, film: Video | None) -> None:
        self._shown_choice = self.choice
        if not self.is_live or film is not None:
            self.put(film)

    def _fail(self, sentence: str) -> None:
        choice = self._shown_choice  # the open film stays
        changes = {"path": choice.path, "axis": choice.axis, "opening": choice.opening}
        self.edit(lambda choice: replace(choice, **changes))  # type: ignore[arg-type]
        self.failed.emit(sentence)

    def put(self, film: Video | None, is_live: bool = False) -> None:
        self.film, self.is_live, self.live_frame = film, is_live, None
        self.player.set_film(0 if is_live else self.count, self.rate)
        self.opened.emit(film)
        self.show()

    def show_live_film(self, film: Video) -> None:
        self.is_live = True
        self.edit(lambda choice: choice.open(None))
        self.put(film, is_live=True)

    def close(self) -> None:
        """Close the film, so that only the simulated film is left."""
        self.is_live = False
        self.edit(lambda choice: choice.open(None))
        if self.film is not None:
            self.put(None)

    def show_live(self, frame: VideoFrame) -> None:
        self.live_frame = frame
        if self.loader.is_idle:  # else this frame is skipped
            self.show()

    def show(self) -> None:
        if not self._is_visible or (self.is_live and self.live_frame is None):
            return
        is_fast = self.player.is_playing or self.is_live
        self.loader.ask(
            FrameRequest(
                film=self.film,
                live=self.live_frame,
                index=0 if self.is_live else self.player.index,
                scene=self._scenes.seen,
                settings=self._scenes.settings.settings,
                recording=self.choice.recording,
                draft_step=_DRAFT_STEP if is_fast else 1,
            )
        )

    def _on_playing(self, playing: bool) -> None:
        if not playing:
            self.show()

    def apply_recording(self) -> None:
        if self.film is None:
            index = self.player.index
            self.player.set_film(self.count, self.rate)
            self.player.index = min(index, self.count - 1)
        self.show()
