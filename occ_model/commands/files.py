"""Check the files of a command line before its work: each output can be written safely."""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from occ_model.errors import OutputError, one_line
from occ_model.files.writing import check_ending, check_replaceable, format_of_image
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
    check_ending: Callable[[Path], object] = lambda _path: None
    # Names of the files, if the path is their folder
    names: tuple[str, ...] = ()


PICTURE = OutputFiles(format_of_image)
SCENE_FILE = OutputFiles(check_scene_path)
TABLE = OutputFiles(lambda path: check_ending(path, "a table", (".csv",)))


def folder_of_figures(*names: str) -> OutputFiles:
    """Describe a folder of figures with these names, each as PDF, PNG and CSV."""
    endings = ("pdf", "png", "csv")
    return OutputFiles(names=tuple(f"{name}.{end}" for name in names for end in endings))


def check_files(options: argparse.Namespace) -> None:
    """Refuse a command line that would overwrite a file that it names, or cannot write one.

    ``options.writes`` maps an option to its :class:`OutputFiles`, or to a function of the parsed
    command line that returns them. It is an OutputError if an output is one of the inputs, by its
    path or by a link, if two outputs are one file, or if a file has a wrong ending or cannot be
    written.
    """
    inputs, outputs = list(_list_inputs(options)), list(_list_outputs(options))
    files = [each for output in outputs for each in _list_files(*output)]
    for place, (name, path) in enumerate(files):
        for other, input_path in inputs:
            if is_same_file(path, input_path):
                raise OutputError(
                    f"{name} is {one_line(str(path))}, the same file as {other}; name another file "
                    "to write to."
                )
        for other, written in files[:place]:
            if is_same_file(path, written):
                raise OutputError(
                    f"{other} and {name} are the same file, {one_line(str(path))}; name two."
                )
    for _, path, output in outputs:
        output.check_ending(path)
        if not output.names:
            check_replaceable(path)


def _list_inputs(options: argparse.Namespace) -> Iterator[tuple[str, Path]]:
    values = vars(options)
    for option, name in INPUTS.items():
        paths = values.get(option)
        if paths is not None:
            yield from ((name, path) for path in (paths if isinstance(paths, list) else [paths]))
    if values.get("preset") is not None and values.get("scene") is None:
        yield "the file of --preset", user_folder() / f"{options.preset}.toml"


def _list_outputs(options: argparse.Namespace) -> Iterator[tuple[str, Path, OutputFiles]]:
    values = vars(options)
    for option, name in OUTPUTS.items():
        path: Path | None = values.get(option)
        if path is not None:
            output = values.get("writes", {}).get(option, OutputFiles())
            yield name, path, output if isinstance(output, OutputFiles) else output(options)


def _list_files(name: str, path: Path, output: OutputFiles) -> list[tuple[str, Path]]:
    if not output.names:
        return [(name, path)]
    return [(f"{name}, where {file} goes,", path / file) for file in output.names]


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
