"""Folders of the user's own files, such as presets and lessons."""

import os
from pathlib import Path


def user_folder(variable: str, name: str) -> Path:
    """Return a folder of the user's own files, which need not exist yet."""
    folder = os.environ.get(variable)
    if folder:
        return Path(folder)
    # Not needed where the folder is named.
    from platformdirs import user_config_path

    return user_config_path("occ-explorer", appauthor=False) / name


def files_in(folder: Path, ending: str) -> list[Path]:
    """List the files in a folder that have an ending, readable or not, but no hidden ones."""
    try:
        return sorted(p for p in folder.glob(f"*{ending}") if not p.name.startswith("."))
    except (OSError, ValueError):  # it is missing, unreadable, or cannot exist
        return []
