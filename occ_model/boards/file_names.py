"""Names of the files that a folder for a board has."""

import re
from pathlib import Path

from occ_model.boards.board import Board

SCENE = "scene.toml"

_SKETCH_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,62}")  # a name for the Arduino IDE
_DEFAULT_NAME = "blink"


def sketch_name(folder: Path, board: Board) -> str:
    """Name the sketch's file: as its folder, which the Arduino IDE wants, or ``main.py``."""
    if board.ending == ".py":
        return f"main{board.ending}"
    name = folder.resolve().name
    return f"{name if _SKETCH_NAME.fullmatch(name) else _DEFAULT_NAME}{board.ending}"


def file_names(folder: Path, board: Board) -> tuple[str, ...]:
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
