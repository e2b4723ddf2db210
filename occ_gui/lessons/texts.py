"""Labels and buttons of the lessons, in their few sizes."""

import html
import re

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QPushButton

_INDEX = re.compile(r"\b([A-Za-z]+)_([A-Za-z]+)\b")
_HEADING = 1.25


def typeset(text: str) -> str:
    """Typeset indices such as that of t_r, and escape all else."""
    return _INDEX.sub(r"<i>\1</i><sub>\2</sub>", html.escape(text, quote=False))


def paragraph(text: str = "") -> QLabel:
    label = QLabel(text)
    label.setWordWrap(True)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


def typeset_paragraph() -> QLabel:
    """Make a label for text with indices, set by :func:`typeset`."""
    label = paragraph()
    label.setTextFormat(Qt.TextFormat.RichText)
    return label


def heading(text: str = "") -> QLabel:
    label = paragraph(text)
    font = label.font()
    font.setBold(True)
    font.setPointSizeF(font.pointSizeF() * _HEADING)
    label.setFont(font)
    return label


def bold(label: QLabel) -> QLabel:
    font = label.font()
    font.setBold(True)
    label.setFont(font)
    return label


def button(text: str, tip: str) -> QPushButton:
    made = QPushButton(text)
    made.setToolTip(tip)
    return made
