"""Plain text: text from files is shown literally, not as markup or with Qt's special characters."""

import html

from PySide6.QtGui import (
    QGuiApplication,
    Qt,  # only this one has mightBeRichText
)

from occ_model.errors import one_line

LONGEST_TEXT = 4000  # most characters of a text that is shown


def in_tool_tip(text: str) -> str:
    """Escape a text for a tooltip or a message box, so that it is not read as rich text."""
    if not Qt.mightBeRichText(text):
        return text
    return f'<p style="white-space: pre">{html.escape(text)}</p>'


def in_menu(text: str) -> str:
    """Escape a text for a menu or a button, where ``&`` marks a shortcut."""
    return one_line(text).replace("&", "&&")


def in_title(text: str) -> str:
    """Escape a text for the title of a window, where ``[*]`` marks a change."""
    return one_line(text).replace("[*]", "[*][*]")


def strip_mnemonics(text: str) -> str:
    """Return the text of a menu entry without the marks of shortcut letters."""
    return text.replace("&&", "\0").replace("&", "").replace("\0", "&")


_MAX_SHOWN_CHARACTERS = 80  # characters of a copied text that the message shows


def copy_text(text: str) -> str:
    QGuiApplication.clipboard().setText(text)
    first, _, rest = text.strip().partition("\n")
    return f"Copied: {one_line(f'{first} …' if rest else first, _MAX_SHOWN_CHARACTERS)}"
