"""Transmitter controller: writes the files with which a board sends the scene."""

from dataclasses import dataclass
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.background.task import Task
from occ_gui.core.store import NO_GESTURE
from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Service
from occ_gui.transmitter.transmitter_dialog import TransmitterDialog
from occ_model.boards.chip_table import frequency_lines
from occ_model.boards.sketch import BOARDS, DEFAULT_BOARD, board_named, write_sketch
from occ_model.boards.transmission import Transmission, prepare_transmission
from occ_model.errors import OccError, OutputError, one_line
from occ_model.scene.scene import Scene

# Importing Matplotlib takes half a second, so functions that need it import it when called.

MOST_FOLDERS = 1000


@dataclass(frozen=True, eq=False, slots=True)
class WiringDrawing:
    """The wiring as a PNG picture, and a description of it in words."""

    transmission: Transmission
    png: bytes
    text: str


@dataclass(frozen=True, eq=False, slots=True)
class SavedFiles:
    """The new folder, its number of files, and why there is no WAV file; empty if there is one."""

    folder: Path
    files: int
    why_no_wav: str


def draw_wiring(transmission: Transmission) -> WiringDrawing:
    from occ_model.figures.transmitter_files import circuit_notes, wiring_bytes

    return WiringDrawing(
        transmission, wiring_bytes(transmission, "png"), "\n".join(circuit_notes(transmission))
    )


@dataclass(frozen=True, eq=False, slots=True)
class SaveJob:
    """What to send, and the parent of its new folder."""

    transmission: Transmission
    parent: Path


def save_files(job: SaveJob) -> SavedFiles:
    from occ_model.figures.transmitter_files import write_transmitter_files

    folder = free_folder(job.parent, f"blink-{job.transmission.board.name}")
    paths, why_no_wav = write_transmitter_files(folder, job.transmission)
    return SavedFiles(folder, len(paths), why_no_wav)


def free_folder(parent: Path, name: str) -> Path:
    """Return the path of a new folder, with a number after its name if the name is taken."""
    for number in range(1, MOST_FOLDERS):
        folder = parent / (name if number == 1 else f"{name}-{number}")
        if not folder.exists():
            return folder
    raise OutputError(
        f"{one_line(str(parent))} already has {MOST_FOLDERS - 1:,} folders {name}; choose another "
        "folder."
    )


_BOARD_KEY = "transmitter/board"  # preference that stores the board


class TransmitterController(Service):
    def __init__(self, window: QWidget, scenes: SceneStore, preferences: Preferences) -> None:
        super().__init__()
        self._window = window
        self._scenes = scenes
        self._preferences = preferences
        self._transmission: Transmission | None = None
        stored = preferences.recall(_BOARD_KEY)
        self._board = stored if stored in BOARDS else DEFAULT_BOARD
        self.dialog: TransmitterDialog | None = None
        self.drawing: Task[Transmission, WiringDrawing] = Task(
            lambda request, _: draw_wiring(request), "wiring"
        )
        self.saving: Task[SaveJob, SavedFiles] = Task(
            lambda request, _: save_files(request), "transmitter files"
        )
        self.tasks = (self.drawing, self.saving)
        self.drawing.finished.connect(self._show_wiring)
        self.drawing.failed.connect(self._show_drawing_failure)
        self.saving.finished.connect(self._report_files)
        self.saving.failed.connect(self._show_note)
        scenes.changed.connect(self._follow)

    def show(self) -> None:
        if self.dialog is None:
            titles = {name: board.title for name, board in BOARDS.items()}
            self.dialog = TransmitterDialog(titles, self._window)
            self.dialog.board.show_key(self._board)
            self.dialog.board_chosen.connect(self._choose_board)
            self.dialog.frequency_asked.connect(self._take_frequency)
            self.dialog.save_asked.connect(self.ask_to_save)
            self.dialog.finished.connect(self._forget_dialog)
            self._follow(self._scenes.seen)
        self.dialog.show()
        self.dialog.activateWindow()

    def _forget_dialog(self) -> None:
        self.dialog = None
        self._transmission = None

    def _choose_board(self, board: str) -> None:
        self._board = board
        self._preferences.keep(_BOARD_KEY, board)
        self._follow(self._scenes.seen)

    def _follow(self, scene: Scene) -> None:
        if self.dialog is None:
            return
        self.dialog.note.setText("")
        try:
            self._transmission = prepare_transmission(scene, board_named(self._board))
        except OccError as error:
            self._transmission = None
            self.dialog.show_refusal(str(error))
            return
        facts = " ".join(frequency_lines(self._transmission))
        self.dialog.show_transmission(
            facts, write_sketch(self._transmission), is_rounded=not self._transmission.is_exact
        )
        self.drawing.ask(self._transmission)

    def _show_wiring(self, drawing: WiringDrawing) -> None:
        # A drawing for an earlier scene or board is not shown.
        if self.dialog is not None and drawing.transmission is self._transmission:
            self.dialog.show_wiring(drawing.png, drawing.text)

    def _show_drawing_failure(self, sentence: str) -> None:
        if self.dialog is not None:
            self.dialog.replace_wiring(sentence)

    def _take_frequency(self) -> None:
        if self._transmission is not None:
            self._scenes.change(NO_GESTURE, **self._transmission.sent_values)

    def ask_to_save(self) -> None:
        """Ask where to make the new folder, and save the files there."""
        title = "Make a folder for the board in"
        folder = QFileDialog.getExistingDirectory(self.dialog, title, self._preferences.folder)
        if folder:
            self.save(Path(folder))

    def save(self, parent: Path) -> None:
        if self._transmission is not None:
            self._show_note("Writing…")
            self.saving.ask(SaveJob(self._transmission, parent))

    def _report_files(self, saved: SavedFiles) -> None:
        self._preferences.remember_folder(saved.folder)
        folder = one_line(str(saved.folder))
        text = f"Saved {saved.files} files in {folder}; scene.toml has the frequency that is sent."
        self._show_note(f"{text} {saved.why_no_wav}".strip())

    def _show_note(self, text: str) -> None:
        if self.dialog is not None:
            self.dialog.note.setText(text)
        else:
            self.status_message.emit(text)
