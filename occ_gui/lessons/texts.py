"""Labels of the lessons, in their few sizes."""

import html
import re

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from occ_gui.widgets import named
from occ_gui.widgets.text_scale import emboldened

_INDEX = re.compile(r"\b([A-Za-z]+)_([A-Za-z]+)\b")
_HEADING = 1.25


def typeset(text: str) -> str:
    """Typeset indices such as that of t_r, and escape all else."""
    return _INDEX.sub(r"<i>\1</i><sub>\2</sub>", html.escape(text, quote=False))


def paragraph(text: str = "") -> QLabel:
    return named.paragraph(text, is_selectable=True)


def typeset_paragraph() -> QLabel:
    """Make a label for text with indices, set by :func:`typeset`."""
    label = paragraph()
    label.setTextFormat(Qt.TextFormat.RichText)
    return label


def heading(text: str = "") -> QLabel:
    return emboldened(paragraph(text), _HEADING)
