"""Check the files that a command line reads and writes: no output may overwrite another one."""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from occ_model.errors import OutputError, one_line
from occ_model.scene.from_text import check_scene_path
from occ_model.scene.presets import user_folder

INPUTS = {  # options that name a file to read, or several, with the file's name in messages
    "file": "the photo",
    "more": "one of the photos",
    "files": "one of the files to open",
    "scene": "the file of --scene",
    "data": "the file of --data",
    "photo": "the file of --photo",
    "photo_68us": "the file of --photo-68us",
    "photo_136us": "the file of --photo-136us",
}

OUTPUTS = {  # options that name a file or folder to write
    "out": "--out",
    "save_scene": "--save-scene",
    "plot": "--plot",
    "screenshot": "--screenshot",
}


@dataclass(frozen=True, slots=True)
class Written:
    """What a command writes to the path of an option."""

    # Refuses a path that has another ending
    check: Callable[[Path], object] = lambda _path: None
    # The files that are written, where the path is that of their folder
    names: tuple[str, ...] = ()


def _check_table_path(path: Path) -> None:
    if path.suffix.lower() != ".csv":
        raise OutputError(f"{one_line(str(path))} does not have the ending of a table; use .csv.")


SCENE_FILE = Written(check_scene_path)
TABLE = Written(_check_table_path)


def folder_of_figures(*names: str) -> Written:
    """Describe a folder of figures of these names, each as PDF, PNG and CSV."""
    endings = ("pdf", "png", "csv")
    return Written(names=tuple(f"{name}.{end}" for name in names for end in endings))


def check_files(options: argparse.Namespace) -> None:
    """Refuse a command line that would write a file over another one that it names.

    ``options.writes`` maps an option to what is written to its path, or to a function of the parsed
    command line that says so. Raises OutputError: an output is one of the inputs, by its path or by
    a link; two outputs are one file; or a file has the ending of another kind.
    """
    inputs, outputs = list(_inputs(options)), list(_outputs(options))
    for place, (name, path) in enumerate(outputs):
        for other, read in inputs:
            if is_same_file(path, read):
                raise OutputError(
                    f"{name} is {one_line(str(path))}, the same file as {other}; name another file "
                    "to write to."
                )
        for other, written in outputs[:place]:
            if is_same_file(path, written):
                raise OutputError(
                    f"{other} and {name} are the same file, {one_line(str(path))}; name two."
                )
    _check_endings(options)


def _check_endings(options: argparse.Namespace) -> None:
    for option in vars(options).get("writes", {}):
        path: Path | None = getattr(options, option)
        if path is not None:
            _written(options, option).check(path)


def _inputs(options: argparse.Namespace) -> Iterator[tuple[str, Path]]:
    named = vars(options)
    for option, name in INPUTS.items():
        paths = named.get(option)
        if paths is not None:
            yield from ((name, path) for path in (paths if isinstance(paths, list) else [paths]))
    if named.get("preset") is not None and named.get("scene") is None:
        yield "the file of --preset", user_folder() / f"{options.preset}.toml"


def _outputs(options: argparse.Namespace) -> Iterator[tuple[str, Path]]:
    named = vars(options)
    for option, name in OUTPUTS.items():
        path: Path | None = named.get(option)
        if path is None:
            continue
        written = _written(options, option)
        if written.names:
            yield from ((f"{name}, where {each} goes,", path / each) for each in written.names)
        else:
            yield name, path


def _written(options: argparse.Namespace, option: str) -> Written:
    written: Written | Callable[[argparse.Namespace], Written]
    written = vars(options).get("writes", {}).get(option, Written())
    return written if isinstance(written, Written) else written(options)


def is_same_file(path: Path, other: Path) -> bool:
    """Return whether two paths are, or would be, the same file, whatever links or letter case."""
    try:
        return path.samefile(other)
    except (OSError, ValueError):  # one of them does not exist yet
        pass
    try:
        path, other = path.resolve(), other.resolve()
    except (OSError, ValueError, RuntimeError):  # a link to itself, before Python 3.13
        return False
    if path == other:
        return True
    alike = path.name.casefold() == other.name.casefold()
    return (
        alike
        and _is_same_folder(path.parent, other.parent)
        and (path.name == other.name or ignores_case(path.parent))
    )


def _is_same_folder(folder: Path, other: Path) -> bool:
    try:
        return folder.samefile(other)
    except (OSError, ValueError):
        return folder == other


def ignores_case(folder: Path) -> bool:
    """Try with a name in a folder whether names that differ only in case are the same file."""
    try:
        inside = [path for path in folder.iterdir() if path.name != path.name.swapcase()][:1]
    except OSError:
        inside = []
    for path in (*inside, folder, *folder.parents):
        if path.name != path.name.swapcase():
            try:
                return path.samefile(path.with_name(path.name.swapcase()))
            except OSError:
                return False
    return False
