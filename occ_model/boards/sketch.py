"""The boards by name, the sketches that blink a scene on them, and the names of the files."""

import re
from collections.abc import Callable
from pathlib import Path

from occ_model.boards.arduino import NANO, UNO, arduino_sketch
from occ_model.boards.board import TransmitterBoard
from occ_model.boards.esp32 import ESP32, esp32_sketch
from occ_model.boards.pico import PICO, pico_sketch
from occ_model.boards.transmission import Transmission, prepare_transmission
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.scene import Scene

BOARDS: dict[str, TransmitterBoard] = {board.name: board for board in (UNO, NANO, ESP32, PICO)}

DEFAULT_BOARD = UNO.name

_SKETCHES: dict[str, Callable[[Transmission], str]] = {
    UNO.name: arduino_sketch,
    NANO.name: arduino_sketch,
    ESP32.name: esp32_sketch,
    PICO.name: pico_sketch,
}


def board_named(name: str) -> TransmitterBoard:
    check_choice("board", name, tuple(BOARDS))
    return BOARDS[name]


def write_sketch(transmission: Transmission) -> str:
    return _SKETCHES[transmission.board.name](transmission)


def transmitter_sketch(scene: Scene, board: str = DEFAULT_BOARD) -> str:
    """Write a complete program that lets a board blink what a scene's transmitter sends.

    The pin repeats :func:`occ_model.packet` without gaps, or blinks as a lamp or in flashes. A
    chip, or a lamp's period and its lit part, last whole numbers of cycles of the board's clock, so
    the sent frequency may differ from the scene's; the comment at the head states it and its error.

    Parameters
    ----------
    board
        ``"arduino-uno"``, ``"arduino-nano"``, ``"esp32"`` or ``"raspberry-pi-pico"``.

    Returns
    -------
    str
        C++ for the Arduino IDE, or MicroPython for the Pico.

    Raises
    ------
    ParameterError
        There is no such board, it cannot blink that fast or slowly, the light has more levels than
        lit and dark, or the packet does not fit into its memory.
    PluginError
        A plug-in fails.
    """
    return write_sketch(prepare_transmission(scene, board_named(board)))


SCENE = "scene.toml"

_SKETCH_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,62}")  # a name for the Arduino IDE
_DEFAULT_NAME = "blink"


def sketch_name(folder: Path, board: TransmitterBoard) -> str:
    """Name the sketch's file after its folder, as the Arduino IDE requires, or ``main.py``."""
    if board.ending == ".py":
        return f"main{board.ending}"
    name = folder.resolve().name
    return f"{name if _SKETCH_NAME.fullmatch(name) else _DEFAULT_NAME}{board.ending}"


def file_names(folder: Path, board: TransmitterBoard) -> tuple[str, ...]:
    return (
        sketch_name(folder, board),
        "waveform.csv",
        "waveform.vcd",
        "waveform.wav",
        "wiring.pdf",
        "wiring.svg",
        "wiring.png",
        SCENE,
    )
