"""Preferences: recent files, last folder and options, stored for the next start."""

from pathlib import Path

from PySide6.QtCore import QObject, QSettings, Signal

MOST_RECENT = 8  # most recent files in the list

_FILES, _FOLDER = "files/recent", "files/folder"
_EXPORTS = "files/exports"
_FOLDERS = (_FOLDER, _EXPORTS)
_STRIPS, _NO = "view/strips", "no"

_MAX_TEXT_LENGTH = 1_000_000  # maximum characters of a stored text


class Preferences(QObject):
    """Recent files, the last folders, and texts by key; stored in ``settings``, if given."""

    changed = Signal()  # the list of recent files has changed

    def __init__(self, settings: QSettings | None = None) -> None:
        super().__init__()
        self._settings = settings
        self._values_in_memory: dict[str, str | list[str]] = {}
        self.files = _parse_paths(self._read_value(_FILES))
        self._folders = {
            key: next(iter(_parse_paths(self._read_value(key))), None) for key in _FOLDERS
        }

    @property
    def folder(self) -> str:
        """The folder in which dialogs to open files start; before the first file, that of figures.

        Empty for the system's folder.
        """
        return self._find_folder(_FOLDER) or self._find_folder(_EXPORTS)

    @property
    def export_folder(self) -> str:
        """The folder in which figures are saved; before the first figure, that of opened files."""
        return self._find_folder(_EXPORTS) or self._find_folder(_FOLDER)

    def _find_folder(self, key: str) -> str:
        folder = self._folders[key]
        try:
            exists = folder is not None and folder.is_dir()
        except OSError:  # such as a name that is too long for the file system
            exists = False
        return str(folder) if exists else ""

    @property
    def slider_strips(self) -> bool:
        return self._read_value(_STRIPS) != _NO

    def keep_slider_strips(self, are_visible: bool) -> None:
        self._write(_STRIPS, "yes" if are_visible else _NO)

    def add(self, path: Path) -> None:
        """Add to the recent files, and store the folder."""
        path = path.absolute()
        self.remember_folder(path)
        others = (other for other in self.files if other != path)
        self._keep((path, *others)[:MOST_RECENT])

    def drop(self, path: Path) -> None:
        self._keep(tuple(other for other in self.files if other != path))

    def clear(self) -> None:
        self._keep(())

    def remember_folder(self, path: Path) -> None:
        self._remember(_FOLDER, path)

    def remember_export_folder(self, path: Path) -> None:
        self._remember(_EXPORTS, path)

    def _remember(self, key: str, path: Path) -> None:
        folder = self._folders[key] = path.absolute().parent
        self._write(key, text_of(folder))

    def _keep(self, files: tuple[Path, ...]) -> None:
        if files != self.files:
            self.files = files
            self._write(_FILES, [text for path in files if (text := text_of(path))])
            self.changed.emit()

    def recall(self, key: str) -> str:
        """Return the text stored under a key; empty if none."""
        value = self._read_value(key)
        return value if isinstance(value, str) and len(value) <= _MAX_TEXT_LENGTH else ""

    def keep(self, key: str, text: str) -> None:
        self._write(key, text)

    def _read_value(self, key: str) -> object:
        try:
            value = self._values_in_memory.get(key)
            return value if self._settings is None else self._settings.value(key)
        except RuntimeError:  # a type of Qt that Python cannot represent
            return None

    def _write(self, key: str, value: str | list[str]) -> None:
        if self._settings is None:
            self._values_in_memory[key] = value
        elif value != self._read_value(key):  # QSettings writes the whole file at each change
            self._settings.setValue(key, value)


def text_of(path: Path) -> str:
    """Return a path as text to store; empty if it is not valid Unicode, which Qt would change."""
    text = str(path)
    return text if text == text.encode("utf-8", "replace").decode("utf-8") else ""


def _parse_paths(value: object) -> tuple[Path, ...]:
    """Parse stored paths, and omit what is not an absolute path."""
    texts = value if isinstance(value, list) else [value]
    paths = [Path(text) for text in texts if isinstance(text, str)]
    absolute = [path for path in paths if path.is_absolute()]
    return tuple(dict.fromkeys(absolute))[:MOST_RECENT]
