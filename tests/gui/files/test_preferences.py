"""Recent files are stored for the next start; invalid paths among them are left out."""

from pathlib import Path

import pytest
from PySide6.QtCore import QSettings

from occ_gui.files.preferences import MOST_RECENT, Preferences


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "settings.ini"


def settings(file: Path) -> QSettings:
    return QSettings(str(file), QSettings.Format.IniFormat)


def remember(file: Path, *paths: Path) -> None:
    kept = settings(file)
    preferences = Preferences(kept)
    for path in paths:
        preferences.add(path)
    kept.sync()


def test_opened_files_are_listed_at_the_next_start_latest_first(file: Path, tmp_path: Path) -> None:
    assert Preferences(settings(file)).files == ()
    paths = [tmp_path / f"{place}, ä.png" for place in range(2)]
    remember(file, *paths)
    assert Preferences(settings(file)).files == tuple(reversed(paths))


def test_a_file_that_is_opened_again_moves_to_the_front_and_only_so_many_are_remembered(
    tmp_path: Path,
) -> None:
    preferences = Preferences()
    a, b = tmp_path / "a", tmp_path / "b"
    for path in (a, b, a):
        preferences.add(path)
    assert preferences.files == (a, b)
    for place in range(MOST_RECENT + 3):
        preferences.add(tmp_path / str(place))
    assert len(preferences.files) == MOST_RECENT
    assert preferences.files[0].name == str(MOST_RECENT + 2)
    assert Preferences().files == ()


def test_the_choice_about_strips_is_stored(file: Path) -> None:
    kept = settings(file)
    for choice in (False, True):
        Preferences(kept).keep_slider_strips(choice)
        assert Preferences(kept).slider_strips is choice


def test_every_change_is_emitted_and_nothing_else(tmp_path: Path) -> None:
    preferences, told = Preferences(), []
    preferences.changed.connect(lambda: told.append(preferences.files))
    preferences.add(tmp_path / "a")
    preferences.add(tmp_path / "a")
    preferences.drop(tmp_path / "b")
    preferences.remember_folder(tmp_path / "c")
    assert told == [(tmp_path / "a",)]
    preferences.drop(tmp_path / "a")
    preferences.clear()
    assert told == [(tmp_path / "a",), ()]


def test_a_dialog_begins_in_the_folder_of_the_last_file_or_where_figures_were_written(
    file: Path, tmp_path: Path
) -> None:
    assert Preferences(settings(file)).folder == ""
    remember(file, tmp_path / "a.png")
    preferences = Preferences(settings(file))
    assert preferences.folder == str(tmp_path)
    preferences.remember_folder(tmp_path / "gone" / "a.png")
    assert preferences.folder == ""
    preferences = Preferences(settings(tmp_path / "other.ini"))
    preferences.remember_export_folder(tmp_path / "picture.png")
    assert preferences.folder == str(tmp_path)


@pytest.mark.parametrize(
    "rubbish", ["", "relative.png", 5, ["", "also/relative"], b"\xff", {"a": 1}, [[1]], True]
)
def test_rubbish_is_ignored(file: Path, rubbish: object) -> None:
    kept = settings(file)
    kept.setValue("files/recent", rubbish)
    kept.setValue("files/folder", rubbish)
    kept.sync()
    preferences = Preferences(settings(file))
    assert preferences.files == ()
    assert preferences.folder == ""


def test_a_file_without_settings_is_like_a_missing_file(file: Path, tmp_path: Path) -> None:
    file.write_bytes(b"\x00\xff[[[=\n%%%")
    preferences = Preferences(settings(file))
    assert preferences.files == ()
    preferences.add(tmp_path / "a")
    assert preferences.files == (tmp_path / "a",)


def test_exports_have_a_folder_of_their_own(file: Path, tmp_path: Path) -> None:
    photos, figures = tmp_path / "photos", tmp_path / "figures"
    for folder in (photos, figures):
        folder.mkdir()
    kept = settings(file)
    preferences = Preferences(kept)
    preferences.add(photos / "a.png")
    assert preferences.export_folder == str(photos)  # nothing was exported yet
    preferences.remember_export_folder(figures / "picture.png")
    assert (preferences.folder, preferences.export_folder) == (str(photos), str(figures))
    preferences.add(photos / "b.png")
    kept.sync()
    again = Preferences(settings(file))
    assert (again.folder, again.export_folder) == (str(photos), str(figures))
