"""Copy a text to the clipboard, and say so: nothing else on the screen shows that it was."""

from PySide6.QtGui import QGuiApplication

from occ_model.errors import one_line

_MAX_SHOWN_CHARACTERS = 80  # characters of a copied text that the message shows


def copy_text(text: str) -> str:
    QGuiApplication.clipboard().setText(text)
    first, _, more = text.strip().partition("\n")
    return f"Copied: {one_line(f'{first} …' if more else first, _MAX_SHOWN_CHARACTERS)}"
