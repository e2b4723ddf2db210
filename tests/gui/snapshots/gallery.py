"""Draws widgets, and tells how far their pictures differ from the stored ones for an eye.

Both are taken tile by tile, and the worst tile counts: in a mean over the whole picture a legend
that has gone would drown in the white around it.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from gui.kinds import Widget, show_widget
from numpy.typing import NDArray
from PIL import Image
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot
from skimage.metrics import structural_similarity

PICTURES = Path(__file__).with_name("pictures")

TILE = 24
"""The side of a tile in pixels: a line of text, or two ticks of an axis."""

LEAST_SIMILARITY = 0.75
"""Least similarity of the worst tile's structure, where 1 means equal."""

MOST_COLOUR = 5.0
"""Largest difference of the worst tile's mean colour, in grey levels from 0 to 255."""

Colours = NDArray[np.uint8]
"""Shape (height, width, 3)."""


@dataclass(frozen=True)
class Difference:
    """The worst tile's similarity of structure, and the worst one's difference of mean colour."""

    similarity: float
    colour: float

    @property
    def is_small(self) -> bool:
        """Whether nobody would call the pictures different."""
        return self.similarity >= LEAST_SIMILARITY and self.colour <= MOST_COLOUR


def tile_means(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Average over tiles that overlap by half: shape (height, width, ...) to (y, x, ...)."""
    step = TILE // 2
    rows, columns = (side // step for side in values.shape[:2])
    parts = values[: rows * step, : columns * step].reshape(rows, step, columns, step, -1)
    quarters = parts.mean(axis=(1, 3))
    halves = quarters[1:] + quarters[:-1]
    return np.asarray(halves[:, 1:] + halves[:, :-1]) / 4.0


def difference(found: Colours, expected: Colours) -> Difference:
    """Compare two pictures of one size, shape (height, width, 3)."""
    if found.shape != expected.shape:
        raise ValueError(f"the picture is {found.shape}, not {expected.shape}")
    _, similarity = structural_similarity(
        found, expected, channel_axis=-1, full=True, data_range=255.0
    )
    colour = np.abs(tile_means(found.astype(float)) - tile_means(expected.astype(float)))
    return Difference(float(tile_means(similarity).min()), float(colour.max()))


_ROUNDS = 50


def grab(widget: QWidget) -> Colours:
    """Draw a widget with one pixel a pixel, shape (height, width, 3)."""
    image = QImage(widget.size(), QImage.Format.Format_RGB888)
    widget.render(image)
    rows = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(image.height(), -1)
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).copy()


def grab_at_rest(widget: QWidget) -> Colours:
    """Draw a widget again and again until it stays the same three times: layouts take rounds."""
    pictures = [grab(widget)]
    for _ in range(_ROUNDS):
        QApplication.processEvents()
        pictures.append(grab(widget))
        if len(pictures) > 3 and all(np.array_equal(p, pictures[-1]) for p in pictures[-4:-1]):
            return pictures[-1]
    raise AssertionError("the widget never comes to rest")


class Gallery:
    """Shows widgets, and compares them with their stored pictures, or stores these anew."""

    def __init__(self, qtbot: QtBot, folder: Path, *, is_renewed: bool) -> None:
        self._qtbot, self._folder, self._is_renewed = qtbot, folder, is_renewed

    def show(self, widget: Widget, width: int = 0, height: int = 0) -> Widget:
        show_widget(self._qtbot, widget, width, height)
        QApplication.processEvents()
        return widget

    def compare(self, widget: QWidget, name: str) -> None:
        path, found = PICTURES / f"{name}.png", grab_at_rest(widget)
        if self._is_renewed:
            # Refined by k-means: a rare colour would be lost among many greys otherwise.
            Image.fromarray(found).quantize(256, kmeans=1).save(path, optimize=True)
            return
        assert path.exists(), f"{path} is missing: pytest --renew-snapshots stores it"
        with Image.open(path) as picture:
            seen = difference(found, np.asarray(picture.convert("RGB")))
        new = self._folder / path.name
        Image.fromarray(found).save(new)
        assert seen.is_small, (
            f"{new} differs from {path}: {seen}; allowed: a similarity from "
            f"{LEAST_SIMILARITY} and a colour to {MOST_COLOUR}. Look at both; if the new one is "
            "as it should be, pytest --renew-snapshots stores it."
        )
