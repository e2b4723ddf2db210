"""Files that are dropped on a window."""

from PySide6.QtWidgets import QWidget


def leave_drops_to_window(parent: QWidget) -> None:
    """Let nothing in a widget take what is dropped on it: a file can be dropped anywhere."""
    for widget in parent.findChildren(QWidget):
        widget.setAcceptDrops(False)
