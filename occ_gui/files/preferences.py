"""What the window remembers from one start to the next."""

from pathlib import Path

from PySide6.QtCore import QObject, QSettings, Signal

MOST_RECENT = 8
"""Files that are remembered."""

_FILES, _FOLDER = "files/recent", "files/folder"
_MARGINS, _NO = "view/margins", "no"

_LONGEST = 1_000_000
"""Characters of a text that is recalled."""

_LONGEST_PATH = 4096
"""Characters of a path that is recalled: no system takes a longer one."""


class Preferences(QObject):
    """The files that were opened last, the folder that they were in, and what is shown.

    Parameters
    ----------
    settings
        Where it is kept; None to keep it only while the window is open.
    """

    changed = Signal()
    """Other files are the recent ones now."""

    def __init__(self, settings: QSettings | None = None) -> None:
        super().__init__()
        self._settings = settings
        self._files = _paths(self._value(_FILES))
        folders = _paths(self._value(_FOLDER))
        self._folder = folders[0] if folders else None

    @property
    def files(self) -> tuple[Path, ...]:
        """The files that were opened last, the latest first."""
        return self._files

    @property
    def folder(self) -> str:
        """The folder that a dialog begins in, empty for the system's own choice."""
        try:
            is_there = self._folder is not None and self._folder.is_dir()
        except OSError:  # such as a name that is too long for the file system
            is_there = False
        return str(self._folder) if is_there else ""

    @property
    def slider_strips(self) -> bool:
        """Whether strips under the sliders show how well a decoder would read."""
        return self._value(_MARGINS) != _NO

    def keep_slider_strips(self, shown: bool) -> None:
        """Remember whether the strips are shown."""
        self._write(_MARGINS, "yes" if shown else _NO)

    def add(self, path: Path) -> None:
        """Remember a file that was opened, and its folder."""
        path = path.absolute()
        self.visit(path)
        others = (other for other in self._files if other != path)
        self._keep((path, *others)[:MOST_RECENT])

    def drop(self, path: Path) -> None:
        """Forget a file."""
        self._keep(tuple(other for other in self._files if other != path))

    def clear(self) -> None:
        """Forget all files."""
        self._keep(())

    def visit(self, path: Path) -> None:
        """Remember a file's folder only."""
        self._folder = path.absolute().parent
        self._write(_FOLDER, text_of(self._folder))

    def _keep(self, files: tuple[Path, ...]) -> None:
        if files != self._files:
            self._files = files
            self._write(_FILES, [text for path in files if (text := text_of(path))])
            self.changed.emit()

    def recall(self, key: str) -> str:
        """Give the text that was kept under a key; empty where there is none."""
        value = self._value(key)
        return value if isinstance(value, str) and len(value) <= _LONGEST else ""

    def keep(self, key: str, text: str) -> None:
        """Remember a text."""
        self._write(key, text)

    def _value(self, key: str) -> object:
        try:
            return None if self._settings is None else self._settings.value(key)
        except RuntimeError:  # of a kind that is none of Python's
            return None

    def _write(self, key: str, value: str | list[str]) -> None:
        if self._settings is not None:
            self._settings.setValue(key, value)


def text_of(path: Path) -> str:
    """Write a path as it is remembered; empty where its name is no text, which Qt would change."""
    text = str(path)
    return text if text == text.encode("utf-8", "replace").decode("utf-8") else ""


def _can_be_path(text: str) -> bool:
    return "\0" not in text and len(text) <= _LONGEST_PATH


def _paths(value: object) -> tuple[Path, ...]:
    """Read what was remembered, leaving out what is no path of a file."""
    texts = value if isinstance(value, list) else [value]
    paths = [Path(text) for text in texts if isinstance(text, str) and _can_be_path(text)]
    absolute = [path for path in paths if path.is_absolute()]
    return tuple(dict.fromkeys(absolute))[:MOST_RECENT]
