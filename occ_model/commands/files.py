"""Check the files of a command line: no output may overwrite another file that it names."""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from occ_model.errors import OutputError, one_line
from occ_model.scene.from_text import check_scene_path
from occ_model.scene.presets import user_folder

INPUTS = {  # options that name files to read, with the files' names in messages
    "file": "the photo",
    "more": "one of the photos",
    "files": "one of the files to open",
    "scene": "the file of --scene",
    "photo": "the file of --photo",
    "photo_68us": "the file of --photo-68us",
    "photo_136us": "the file of --photo-136us",
    "offset_to": "the film of --offset-to",
    "calibration": "one of the files of --calibration",
}

OUTPUTS = {  # options that name a file or folder to write
    "out": "--out",
    "save_scene": "--save-scene",
    "plot": "--plot",
    "screenshot": "--screenshot",
}


@dataclass(frozen=True, slots=True)
class OutputFiles:
    """The files that a command writes at the path of an option."""

    # Refuses a path with a wrong ending
    check: Callable[[Path], object] = lambda _path: None
    # Names of the files, if the path is their folder
    names: tuple[str, ...] = ()


def _check_table_path(path: Path) -> None:
    if path.suffix.lower() != ".csv":
        raise OutputError(f"{one_line(str(path))} does not have the ending of a table; use .csv.")


SCENE_FILE = OutputFiles(check_scene_path)
TABLE = OutputFiles(_check_table_path)


def folder_of_figures(*names: str) -> OutputFiles:
    """Describe a folder of figures with these names, each as PDF, PNG and CSV."""
    endings = ("pdf", "png", "csv")
    return OutputFiles(names=tuple(f"{name}.{end}" for name in names for end in endings))


def check_files(options: argparse.Namespace) -> None:
    """Refuse a command line that would overwrite a file that it names.

    ``options.writes`` maps an option to its :class:`OutputFiles`, or to a function of the parsed
    command line that returns them. It is an OutputError if an output is one of the inputs, by its
    path or by a link, if two outputs are one file, or if a file has a wrong ending.
    """
    inputs, outputs = list(_list_inputs(options)), list(_list_outputs(options))
    for place, (name, path) in enumerate(outputs):
        for other, input_path in inputs:
            if is_same_file(path, input_path):
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
            _outputs_of(options, option).check(path)


def _list_inputs(options: argparse.Namespace) -> Iterator[tuple[str, Path]]:
    values = vars(options)
    for option, name in INPUTS.items():
        paths = values.get(option)
        if paths is not None:
            yield from ((name, path) for path in (paths if isinstance(paths, list) else [paths]))
    if values.get("preset") is not None and values.get("scene") is None:
        yield "the file of --preset", user_folder() / f"{options.preset}.toml"


def _list_outputs(options: argparse.Namespace) -> Iterator[tuple[str, Path]]:
    values = vars(options)
    for option, name in OUTPUTS.items():
        path: Path | None = values.get(option)
        if path is None:
            continue
        written = _outputs_of(options, option)
        if written.names:
            yield from ((f"{name}, where {file} goes,", path / file) for file in written.names)
        else:
            yield name, path


def _outputs_of(options: argparse.Namespace, option: str) -> OutputFiles:
    written: OutputFiles | Callable[[argparse.Namespace], OutputFiles]
    written = vars(options).get("writes", {}).get(option, OutputFiles())
    return written if isinstance(written, OutputFiles) else written(options)


def is_same_file(path: Path, other: Path) -> bool:
    """Return whether two paths are, or would be, the same file, despite links."""
    try:
        return path.samefile(other)
    except (OSError, ValueError):  # one of them does not exist yet
        pass
    try:
        path, other = path.resolve(), other.resolve()
    except (OSError, ValueError, RuntimeError):  # a link to itself, before Python 3.13
        return False
    return path == other
