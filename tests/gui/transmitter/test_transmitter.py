"""The dialog of the transmitter: what the board sends for the present scene, and its files."""

from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path

import pytest
from gui.kinds import add_widget, collect
from gui.pane_bench import PaneBench
from gui.stores import store_of
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.services import transmitter as declared
from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_gui.transmitter import transmitter_controller
from occ_gui.transmitter.transmitter_controller import (
    TransmitterController,
    WiringDrawing,
    free_folder,
)
from occ_gui.transmitter.transmitter_dialog import TransmitterDialog
from occ_model.boards.transmission import Transmission
from occ_model.errors import OutputError
from occ_model.figures import transmitter_files
from occ_model.scene.scene import Scene


@pytest.fixture(autouse=True)
def undrawn(monkeypatch: pytest.MonkeyPatch, png_of: Callable[[str], bytes]) -> None:
    """Replace the drawing of the wiring, which takes long."""

    def draw(sent: Transmission) -> WiringDrawing:
        return WiringDrawing(sent, png_of(sent.board.name), sent.board.title)

    monkeypatch.setattr(transmitter_controller, "draw_wiring", draw)
    monkeypatch.setattr(transmitter_files, "wiring_bytes", lambda sent, format_name: b"")


@pytest.fixture
def png_of() -> Callable[[str], bytes]:

    def png(name: str) -> bytes:
        buffer = BytesIO()
        Image.new("L", (70, 55), len(name)).save(buffer, format="PNG")
        return buffer.getvalue()

    return png


@pytest.fixture
def store() -> SceneStore:
    return store_of(occ.load_preset("phone-68us").replace(switching_frequency=14.7e3))


@pytest.fixture
def transmitter(qtbot: QtBot, store: SceneStore) -> Iterator[TransmitterController]:
    window = add_widget(qtbot, QWidget())
    controller = TransmitterController(window, store, Preferences())
    yield controller
    controller.stop()


def wait(qtbot: QtBot, transmitter: TransmitterController) -> None:
    qtbot.waitUntil(lambda: transmitter.is_idle)


@pytest.fixture
def dialog(transmitter: TransmitterController, qtbot: QtBot) -> TransmitterDialog:
    transmitter.show()
    wait(qtbot, transmitter)
    assert transmitter.dialog is not None
    return transmitter.dialog


def choose_board(dialog: TransmitterDialog, name: str) -> None:
    dialog.board.show_key(name)
    dialog.board.activated.emit(dialog.board.currentIndex())


def test_the_menu_entry_opens_the_dialog_on_the_scene(qtbot: QtBot, small_scene: Scene) -> None:
    bench = PaneBench(qtbot, small_scene)
    bench.shell.add(declared(bench.window, bench.scenes, Preferences(None)), bench.window)
    assert bench.shell.find_pane("transmitter") is None
    bench.window.actions_by_name["transmitter"].trigger()
    bench.wait_until_idle()
    opened = bench.shell.pane("transmitter").dialog
    assert opened.isVisible()
    assert opened.facts.text().startswith("Switching frequency: 10 kHz, as asked")
    bench.scenes.change(switching_frequency=14.7e3)
    bench.wait_until_idle()
    assert opened.take.isEnabled()


def test_the_dialog_states_the_frequency_sent_and_its_error_and_controls_what_they_do(
    dialog: TransmitterDialog,
) -> None:
    assert "14.7058824 kHz, +400 ppm from the 14.7 kHz asked" in dialog.facts.text()
    assert "5,000 ppm" in dialog.facts.text()
    assert dialog.wiring.accessibleDescription() == "Arduino Uno"
    assert not dialog.wiring.pixmap().isNull()
    assert dialog.board.accessibleName() == "Board"
    assert all(control.toolTip() for control in (dialog.save, dialog.take, dialog.board))
    selectable = Qt.TextInteractionFlag.TextSelectableByMouse
    assert all(text.textInteractionFlags() & selectable for text in (dialog.facts, dialog.note))


def test_another_board_sends_another_frequency_and_is_remembered(
    transmitter: TransmitterController, dialog: TransmitterDialog, qtbot: QtBot
) -> None:
    choose_board(dialog, "esp32")
    wait(qtbot, transmitter)
    assert "14.7004778 kHz" in dialog.facts.text()
    assert dialog.wiring.accessibleDescription() == "ESP32"
    dialog.reject()
    transmitter.show()
    again = transmitter.dialog
    assert again is not dialog
    assert again.board.key() == "esp32"
    wait(qtbot, transmitter)


def test_the_sketch_is_shown_as_it_is_saved_and_copied(
    transmitter: TransmitterController, dialog: TransmitterDialog, qtbot: QtBot, tmp_path: Path
) -> None:
    transmitter.save(tmp_path)
    wait(qtbot, transmitter)
    (saved,) = tmp_path.glob("*/*.ino")
    assert dialog.sketch.toPlainText() == saved.read_text(encoding="utf-8").rstrip("\0")
    dialog.copy.click()
    assert QGuiApplication.clipboard().text() == dialog.sketch.toPlainText()
    choose_board(dialog, "raspberry-pi-pico")
    wait(qtbot, transmitter)
    assert "import" in dialog.sketch.toPlainText()
    assert dialog.sketch.isReadOnly()


def test_the_scene_takes_the_sent_frequency_in_a_step_that_can_be_undone(
    store: SceneStore, dialog: TransmitterDialog
) -> None:
    dialog.take.click()
    assert store.scene.transmitter.switching_frequency == 16e6 / 1088
    assert "as asked" in dialog.facts.text()
    assert not dialog.take.isEnabled()
    store.undo_stack.undo()
    assert store.scene.transmitter.switching_frequency == 14.7e3
    assert dialog.take.isEnabled()


@pytest.mark.parametrize("is_open", [True, False])
def test_a_drawing_that_fails_is_told_where_the_dialog_is_open_still(
    store: SceneStore, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, is_open: bool
) -> None:
    def fail(_sent: Transmission) -> WiringDrawing:
        raise OutputError("It cannot be drawn.")

    monkeypatch.setattr(transmitter_controller, "draw_wiring", fail)
    window = add_widget(qtbot, QWidget())
    transmitter = TransmitterController(window, store, Preferences())
    transmitter.show()
    dialog = transmitter.dialog
    if not is_open:
        dialog.reject()
    wait(qtbot, transmitter)
    transmitter.stop()
    # The dialog that is closed is gone: whoever would write to it fails.
    assert transmitter.dialog is (dialog if is_open else None)
    assert not is_open or "It cannot be drawn." in dialog.wiring.text()


def test_a_scene_that_the_board_cannot_send_leaves_no_old_figure(
    store: SceneStore, transmitter: TransmitterController, dialog: TransmitterDialog, qtbot: QtBot
) -> None:
    store.change(switching_frequency=300e3)
    wait(qtbot, transmitter)
    assert dialog.facts.text().startswith("switching_frequency is 300 kHz; allowed on Arduino Uno")
    assert dialog.wiring.pixmap().isNull()
    assert dialog.wiring.accessibleDescription() == ""
    assert not dialog.save.isEnabled()
    assert not dialog.take.isEnabled()
    store.change(switching_frequency=10e3)
    assert dialog.wiring.text() == "Drawing the wiring…"
    wait(qtbot, transmitter)
    assert dialog.save.isEnabled()
    assert not dialog.wiring.pixmap().isNull()


def test_saving_makes_a_new_folder_each_time(
    store: SceneStore,
    transmitter: TransmitterController,
    dialog: TransmitterDialog,
    qtbot: QtBot,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *a: str(tmp_path))
    for name in ("blink-arduino-uno", "blink-arduino-uno-2"):
        dialog.save.click()
        wait(qtbot, transmitter)
        assert dialog.note.text() == (
            f"Saved 8 files in {tmp_path / name}; scene.toml has the frequency that is sent."
        )
        sketch = (tmp_path / name / f"{name}.ino").read_text()
        assert sketch == occ.transmitter_sketch(store.scene, "arduino-uno")
    assert len(list(tmp_path.iterdir())) == 2


def test_what_cannot_be_saved_is_said_in_the_dialog_and_when_closed_in_the_status_line(
    transmitter: TransmitterController, dialog: TransmitterDialog, qtbot: QtBot, tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    transmitter.save(tmp_path / "file")
    wait(qtbot, transmitter)
    assert "cannot be made" in dialog.note.text()
    said = collect(transmitter.status_message)
    transmitter.save(tmp_path)
    dialog.reject()
    qtbot.waitUntil(lambda: bool(said))
    assert said[-1].startswith("Saved 8 files")


def test_folders_of_one_name_are_numbered_up_to_a_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(transmitter_controller, "MOST_FOLDERS", 4)
    for name in ("uno", "uno-2", "uno-3"):
        folder = free_folder(tmp_path, "uno")
        assert folder == tmp_path / name
        folder.mkdir()
    with pytest.raises(OutputError, match="already has 3 folders uno; choose another"):
        free_folder(tmp_path, "uno")


def test_a_lamp_is_shown_with_its_true_values_which_the_scene_can_take(
    transmitter: TransmitterController, dialog: TransmitterDialog, store: SceneStore, qtbot: QtBot
) -> None:
    choose_board(dialog, "arduino-uno")
    store.change(light="lamp")
    store.change(lamp_frequency=239.0)
    store.change(duty=0.3)
    wait(qtbot, transmitter)
    assert "239.005736 Hz" in dialog.facts.text()
    assert "29.9952199 %" in dialog.facts.text()
    dialog.take.click()
    wait(qtbot, transmitter)
    assert store.scene.transmitter.duty == 2510 / 8368
    assert store.scene.transmitter.lamp_frequency == 16e6 / 66_944
    assert not dialog.take.isEnabled()
    store.change(light="mains")
    assert dialog.facts.text().startswith("light is mains; allowed on Arduino Uno: code, lamp")
    assert not dialog.save.isEnabled()
