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
from occ_model.boards.sketch import BOARDS, DEFAULT_BOARD, board_named
from occ_model.boards.transmission import Transmission, prepare_transmission
from occ_model.errors import OccError, OutputError, one_line
from occ_model.files.writing import make_folder
from occ_model.scene.scene import Scene

# matplotlib takes half a second to import, so that functions import what needs it when called.

MOST_FOLDERS = 1000


@dataclass(frozen=True, eq=False, slots=True)
class WiringDrawing:
    """The wiring as a PNG picture, and a description of it in words."""

    sent: Transmission
    png: bytes
    text: str


@dataclass(frozen=True, eq=False, slots=True)
class SavedFiles:
    """The new folder, its number of files, and why there is no WAV file; empty if there is one."""

    folder: Path
    files: int
    missing: str


def draw_wiring(sent: Transmission) -> WiringDrawing:
    from occ_model.figures.transmitter_files import circuit_notes, wiring_bytes

    return WiringDrawing(sent, wiring_bytes(sent, "png"), "\n".join(circuit_notes(sent)))


@dataclass(frozen=True, eq=False, slots=True)
class SaveJob:
    """What is sent, and the parent of its new folder."""

    sent: Transmission
    parent: Path


def save_files(job: SaveJob) -> SavedFiles:
    from occ_model.figures.transmitter_files import write_transmitter_files

    folder = new_folder(job.parent, f"blink-{job.sent.board.name}")
    paths, missing = write_transmitter_files(folder, job.sent)
    return SavedFiles(folder, len(paths), missing)


def new_folder(parent: Path, name: str) -> Path:
    """Make a folder, with a number after its name if the name is taken."""
    for number in range(1, MOST_FOLDERS):
        folder = parent / (name if number == 1 else f"{name}-{number}")
        if not folder.exists():
            make_folder(folder)
            return folder
    raise OutputError(
        f"{one_line(str(parent))} already has {MOST_FOLDERS - 1:,} folders {name}; choose another "
        "folder."
    )


_BOARD = "transmitter/board"  # key of the preference that stores the board


class TransmitterController(Service):
    def __init__(self, window: QWidget, store: SceneStore, preferences: Preferences) -> None:
        super().__init__()
        self._window = window
        self._store = store
        self._preferences = preferences
        self._sent: Transmission | None = None
        stored = preferences.recall(_BOARD)
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
        self.saving.finished.connect(self._report)
        self.saving.failed.connect(self._say)
        store.changed.connect(self._follow)

    def show(self) -> None:
        if self.dialog is None:
            titles = {name: board.title for name, board in BOARDS.items()}
            self.dialog = TransmitterDialog(titles, self._window)
            self.dialog.board.show_key(self._board)
            self.dialog.board_chosen.connect(self._choose)
            self.dialog.frequency_asked.connect(self._take_frequency)
            self.dialog.save_asked.connect(self.ask_to_save)
            self.dialog.finished.connect(self._forget)
            self._follow(self._store.scene)
        self.dialog.show()
        self.dialog.activateWindow()

    def _forget(self) -> None:
        self.dialog = None
        self._sent = None

    def _choose(self, board: str) -> None:
        self._board = board
        self._preferences.keep(_BOARD, board)
        self._follow(self._store.scene)

    def _follow(self, scene: Scene) -> None:
        if self.dialog is None:
            return
        self.dialog.note.setText("")
        try:
            self._sent = prepare_transmission(scene, board_named(self._board))
        except OccError as error:
            self._sent = None
            self.dialog.show_refusal(str(error))
            return
        facts = " ".join(frequency_lines(self._sent))
        self.dialog.show_sent(facts, differs=not self._sent.is_as_asked)
        self.drawing.ask(self._sent)

    def _show_wiring(self, drawn: WiringDrawing) -> None:
        # A drawing for an earlier scene or board is not shown.
        if self.dialog is not None and drawn.sent is self._sent:
            self.dialog.show_wiring(drawn.png, drawn.text)

    def _show_drawing_failure(self, sentence: str) -> None:
        if self.dialog is not None:
            self.dialog.say_of_wiring(sentence)

    def _take_frequency(self) -> None:
        if self._sent is not None:
            self._store.change(NO_GESTURE, **self._sent.sent_values)

    def ask_to_save(self) -> None:
        """Ask where to make the new folder, and save the files there."""
        title = "Make a folder for the board in"
        folder = QFileDialog.getExistingDirectory(self.dialog, title, self._preferences.folder)
        if folder:
            self.save(Path(folder))

    def save(self, parent: Path) -> None:
        if self._sent is not None:
            self._say("Writing…")
            self.saving.ask(SaveJob(self._sent, parent))

    def _report(self, saved: SavedFiles) -> None:
        self._preferences.visit(saved.folder)
        folder = one_line(str(saved.folder))
        text = f"Saved {saved.files} files in {folder}; scene.toml has the frequency that is sent."
        self._say(f"{text} {saved.missing}".strip())

    def _say(self, text: str) -> None:
        if self.dialog is not None:
            self.dialog.note.setText(text)
        else:
            self.status_message.emit(text)
