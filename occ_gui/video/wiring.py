"""The pane of films: connects its view with the controllers that open, show, read and film."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from PySide6.QtCore import QSignalBlocker, Signal

import occ_model as occ
from occ_gui.background.file_writer import FileWriter
from occ_gui.background.task import Report
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import ResultsStore
from occ_gui.values.choices import FilmChoice
from occ_gui.video.film_controller import FilmController
from occ_gui.video.film_reading import Marks, MarkState, frame_marks
from occ_gui.video.frame_jobs import ShownFrame
from occ_gui.video.live_controller import LiveController
from occ_gui.video.reading_controller import FilmReader
from occ_gui.video.video_view import VideoView
from occ_model.errors import OccError, inflect, one_line
from occ_model.results.video import USUAL_RATE, Video
from occ_model.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class _FilmToSave:
    path: Path
    film: Video


def _save(request: _FilmToSave, report: Report) -> Path:
    count = request.film.frame_count or 1
    occ.write_video(request.film, request.path, lambda frames: report(frames / count))
    return request.path


class VideoWiring(Pane[FilmChoice]):
    status_message = Signal(str)
    open_asked = Signal()

    save_asked = Signal()  # the user asked to save the simulated film

    def __init__(self, scenes: SceneStore, results_store: ResultsStore) -> None:
        view = VideoView()
        super().__init__(view)
        self._scenes = scenes
        self._is_frame_missing = False
        self.view = view
        self.films = FilmController(scenes, results_store)
        self.readings = FilmReader()
        self.live = LiveController(self.films, self.readings, lambda: scenes.seen)
        self.saving: FileWriter[_FilmToSave] = FileWriter(
            _save, "writing of the film", self.view.form.saving,
            "The film was cancelled.",
        )  # fmt: skip
        self.saving.status_message.connect(self.status_message)
        self.view.form.save_asked.connect(self.save_asked)
        films = self.films
        self.tasks = (self.saving.task, self.live.finder, self.readings.task,
                      films.opener.task, films.loader)  # fmt: skip
        self._connect_film()
        self._connect_reading()
        self._connect_live()
        scenes.changed.connect(self._on_scene)
        self.view.form.changed.connect(self._on_recording)
        self.view.form.refused.connect(self.status_message)
        self.view.form.show_scene(scenes.seen)
        self.films.put(results_store.results.film)

    def show_part(self, part: FilmChoice) -> None:
        form = self.view.form
        if (form.recording, form.frames) != (part.recording, part.frames):
            form.show_recording(part.recording)
            form.show_frames(part.frames)
            self._show_recording()

    def _connect_film(self) -> None:
        view, films, player = self.view, self.films, self.films.player
        view.bar.open_asked.connect(self.open_asked)
        view.bar.close_asked.connect(self.close)
        films.opened.connect(self._on_film)
        films.failed.connect(self.file_failed)
        films.frame_shown.connect(self._show_frame)
        films.frame_failed.connect(self._on_frame_failure)
        player.frame_requested.connect(view.timeline.show_index)
        player.playing_changed.connect(view.transport.show_playing)
        view.timeline.frame_chosen.connect(player.seek)
        view.transport.step_asked.connect(player.step)
        for control in (view.timeline, view.transport):
            control.play_asked.connect(player.toggle)

    def _connect_reading(self) -> None:
        self.view.bar.read_asked.connect(self.read_or_stop)
        self.readings.changed.connect(self._show_reading)
        self.readings.failed.connect(self.view.show_message)

    def _connect_live(self) -> None:
        bar, live = self.view.bar, self.live
        bar.cameras_asked.connect(self._find_cameras)
        bar.camera_chosen.connect(live.start_camera)
        bar.axis.chosen.connect(self._scan_along)
        bar.lock.toggled.connect(live.lock_exposure)
        live.devices_found.connect(bar.list_cameras)
        live.ended.connect(self._on_live_end)
        live.exposure_refused.connect(self._on_exposure_refused)

    @property
    def path(self) -> Path | None:
        film = self.films.film
        return None if film is None or self.films.is_live else film.path

    @property
    def is_idle(self) -> bool:
        """Whether the frame is shown and the film is read; the reading of a camera never ends."""
        endless_task = self.readings.task if self.live.is_filming else None
        return all(task.is_idle for task in self.tasks if task is not endless_task)

    def set_visible(self, visible: bool) -> None:
        """Show frames while the pane is visible; release the camera when it is hidden."""
        if not visible:
            self.live.stop_filming()
            self._show_bar()
        self.films.set_visible(visible)

    def open(self, path: Path) -> None:
        self.live.stop_filming()
        self.films.open(path)

    def close(self) -> None:
        if self.live.is_filming:
            self.live.stop_filming()
            self._show_bar()
        else:
            self.films.close()

    def read_or_stop(self) -> None:
        if self.readings.is_running:
            self.readings.cancel()
            return
        try:
            film = self.films.film or self.films.simulate()
        except OccError as error:
            self.view.show_message(str(error))
            return
        self.readings.start(film, self._scenes.seen)

    def save(self, path: Path) -> None:
        try:
            self.saving.start(_FilmToSave(path, self.films.simulate()))
        except OccError as error:
            self.status_message.emit(str(error))

    def stop(self) -> None:
        self.films.player.pause()
        self.live.release()
        super().stop()

    # Handling events.

    def _on_film(self, film: Video | None) -> None:
        self.readings.forget()
        self.view.show_message("")
        self._show_lock(False)  # a camera starts with an exposure of its own choice
        self.view.timeline.show_index(0)
        self._adopt_frame_rate(film)
        self._show_bar()
        self.view.pictures.show_film(None, self._placeholder())
        self._show_reading()
        has_code = self._scenes.store.workspace.has_code  # else there is nothing to read
        if film is not None and not self.films.is_live and has_code:
            self.readings.start(film, self._scenes.seen)

    def _adopt_frame_rate(self, film: Video | None) -> None:
        if film is None or self.films.is_live:
            return
        form = self.view.form
        if film.frame_rate:
            try:
                form.show_recording(form.recording.replace(frame_rate=film.frame_rate))
            except OccError:  # a rate that is out of range
                return
            self._keep_recording()
        form.show_scene(self._scenes.seen)

    def _on_scene(self, scene: Scene) -> None:
        self.view.form.show_scene(scene)
        if self.live.is_filming:
            self.live.read()
        self._mark_outdated()

    def _keep_recording(self) -> None:
        form = self.view.form
        self.films.edit(lambda film: replace(film, recording=form.recording, frames=form.frames))

    def _on_recording(self) -> None:
        self._keep_recording()
        self._show_recording()

    def _show_recording(self) -> None:
        self.films.apply_recording()
        self.view.form.show_scene(self._scenes.seen)
        if self.films.film is None:
            self.readings.forget()
            self._show_bar()

    def _on_live_end(self, sentence: str) -> None:
        self.view.show_message(sentence)
        self._show_bar()

    def _on_exposure_refused(self, sentence: str) -> None:
        self._show_lock(not self.view.bar.lock.isChecked())
        self.view.show_message(sentence)

    def _show_lock(self, is_locked: bool) -> None:
        lock = self.view.bar.lock
        with QSignalBlocker(lock):
            lock.setChecked(is_locked)

    def _scan_along(self, axis: str) -> None:
        """Open the film or the camera again, along another axis."""
        if self.live.is_filming:
            self.live.scan_along(axis)
        elif self.path is not None:
            self.films.open(self.path, axis)

    def _find_cameras(self) -> None:
        self.view.bar.list_cameras(None)
        self.live.find()

    # Showing the state.

    def _show_bar(self) -> None:
        film, form = self.films.film, self.view.form
        if film is None:
            title = (
                f"Simulated film: {inflect(form.frames, 'frame')}, "
                f"{form.recording.frame_rate:g} a second"
            )
        elif self.films.is_live:
            title = f"{one_line(film.title)}, {'live' if self.live.is_filming else 'stopped'}"
        else:
            title = _title_of(film)
        self.view.bar.show_film(title, is_film=film is not None, is_live=self.live.is_filming)
        if self.live.video is not None:
            self.view.bar.axis.show_key(self.live.video.axis)
        elif film is not None:
            is_turned = getattr(film, "turned", False)
            self.view.bar.axis.show_key("lines" if is_turned else "columns")
        self.view.transport.set_usable(not self.films.is_live)

    def _on_frame_failure(self, sentence: str) -> None:
        self._is_frame_missing = True
        self.view.show_message(sentence)

    def _show_frame(self, shown: ShownFrame) -> None:
        view = self.view
        if self._is_frame_missing:
            self._is_frame_missing = False
            view.show_message("")
        view.pictures.show_film(shown.film, self._placeholder())
        view.pictures.show_simulated(shown.simulated, shown.refusal)
        view.rows.show_story(shown.story, shown.refusal)
        count = None if self.films.is_live else self.films.player.count
        index = shown.request.index if shown.request.live is None else shown.request.live.index
        view.transport.show_place(index, count, shown.time)

    def _placeholder(self) -> str:
        """Return the text to show while there is no frame of a film."""
        if self.films.film is not None or self.films.is_live:
            return "Loading the frame…"
        return "Open a film, or use a camera, to see it beside the simulated film."

    def _show_reading(self) -> None:
        readings = self.readings
        reading = readings.reading
        self.view.show_reading(reading, self._make_marks())
        self.view.bar.show_state(is_reading=readings.is_running, is_read=readings.is_done)
        if self.films.is_live:
            self.view.timeline.show_index(len(reading.times) - 1)
        elif self.films.film is not None and (readings.is_done or not self.films.count):
            self.films.player.set_count(len(reading.times))
        self._mark_outdated()

    def _mark_outdated(self) -> None:
        scene = self.readings.scene
        self.view.show_outdated(scene is not None and scene != self._scenes.seen)

    def _make_marks(self) -> Marks:
        """Return marks for the frames that were read and for the frames to come."""
        reading = self.readings.reading
        read_count = len(reading.times)
        step = 1.0 / (self.films.rate or USUAL_RATE)
        pending_count = 0
        if not (self.films.is_live or (self.readings.is_done and self.films.film is not None)):
            pending_count = max(self.films.count - read_count, 0)
        first = float(reading.times[-1]) + step if read_count else 0.0
        times = np.concatenate([reading.times, first + step * np.arange(pending_count)])
        pending = np.full(pending_count, MarkState.PENDING, dtype=np.uint8)
        return frame_marks(times, np.concatenate([reading.states, pending]), step)


def _title_of(film: Video) -> str:
    rows, columns = film.shape
    parts = [one_line(film.title), f"{columns} x {rows}"]
    if film.frame_count:
        parts.append(inflect(film.frame_count, "frame"))
    if film.frame_rate:
        parts.append(f"{film.frame_rate:.4g} a second")
    return ", ".join(parts)
