"""Find the files of the package, in an installation or a checkout, and the user's own files."""

import os
from pathlib import Path


def resource_names(folder: str, ending: str) -> tuple[str, ...]:
    """List the sorted names of a folder's files that have an ending, without the ending."""
    names = (entry.name for entry in resource_path(folder).iterdir())
    return tuple(sorted(name.removesuffix(ending) for name in names if name.endswith(ending)))


def resource_text(*parts: str) -> str:
    return resource_path(*parts).read_text(encoding="utf-8")


def resource_path(*parts: str) -> Path:
    """Return the path of a file inside the installed package, or next to it in a checkout."""
    package = Path(__file__).parents[1]
    inside = package / "resources"
    root = inside if inside.is_dir() else package.parent / "resources"
    return root.joinpath(*parts)


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
