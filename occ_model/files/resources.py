"""Find the files of the package, wherever it is imported from, and the user's own files."""

import atexit
import os
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # slow to import, and needed only if the package is in an archive
    from importlib.resources.abc import Traversable


def resource_names(folder: str, ending: str) -> tuple[str, ...]:
    """List the sorted names of a folder's files that have an ending, without the ending."""
    names = (entry.name for entry in find_resource(folder).iterdir())
    return tuple(sorted(name.removesuffix(ending) for name in names if name.endswith(ending)))


def resource_text(*parts: str) -> str:
    return find_resource(*parts).read_text(encoding="utf-8")


def resource_path(*parts: str) -> Path:
    """Return the path of a resource; from an archive it is a copy until the program ends."""
    resource = find_resource(*parts)
    return resource if isinstance(resource, Path) else _copy_of(parts)


def find_resource(*parts: str) -> "Path | Traversable":
    """Find a resource inside an installed package, or next to the packages in a checkout."""
    package = Path(__file__).parents[1]
    for root in (package / "resources", package.parent / "resources"):
        if root.is_dir():
            return root.joinpath(*parts)
    from importlib.resources import files

    return files("occ_model").joinpath("resources", *parts)


@lru_cache
def _copy_of(parts: tuple[str, ...]) -> Path:
    target = Path(_make_folder_of_copies(), *parts)
    _copy(find_resource(*parts), target)
    return target


@lru_cache
def _make_folder_of_copies() -> str:
    # Needed only if the package is in an archive.
    import shutil
    import tempfile

    folder = tempfile.mkdtemp(prefix="occ-resources-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def _copy(resource: "Path | Traversable", target: Path) -> None:
    if resource.is_dir():
        target.mkdir(parents=True, exist_ok=True)
        for entry in resource.iterdir():
            _copy(entry, target / entry.name)
    elif resource.is_file():  # a missing file has no copy
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(resource.read_bytes())


def user_folder(variable: str, name: str) -> Path:
    """Return a folder of the user's own files, which need not exist yet."""
    folder = os.environ.get(variable)
    if folder:
        return Path(folder)
    # Not needed if the folder is given.
    from platformdirs import user_config_path

    return user_config_path("occ-explorer", appauthor=False) / name


def files_in(folder: Path, ending: str) -> list[Path]:
    """List the files in a folder that have an ending, readable or not, except hidden ones."""
    try:
        return sorted(p for p in folder.glob(f"*{ending}") if not p.name.startswith("."))
    except (OSError, ValueError):  # the folder is missing, unreadable, or cannot exist
        return []
