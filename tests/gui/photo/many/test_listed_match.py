"""A photo of the table opens with the match that the table has found in it."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from gui.user import User
from PySide6.QtCore import Qt

from occ_gui.app.application import Application
from occ_gui.files.file_controller import sample_photos
from occ_model.photo.many import match_photos
from occ_model.photo.many.row import MatchSettings, row_of
from occ_model.results.photo_table import PhotoRow

Found = dict[tuple[Path, MatchSettings], PhotoRow]


@pytest.fixture(scope="module")
def paths(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, ...]:
    """Make two copies of a photo."""
    (sample,) = [path for path in sample_photos() if path.stem == "led-1khz"]
    folder = tmp_path_factory.mktemp("photos")
    paths = tuple(folder / f"{name}.jpg" for name in ("one", "two"))
    for path in paths:
        path.write_bytes(sample.read_bytes())
    return paths


@pytest.fixture(scope="module")
def found_rows() -> Found:
    """Keep what the table has found."""
    return {}


@pytest.fixture
def listed(
    application: Application, user: User, paths: tuple[Path, ...], found_rows: Found,
    monkeypatch: pytest.MonkeyPatch,
) -> tuple[Path, ...]:  # fmt: skip
    """Match the copies in the table, in this process, and each of them once."""

    def row(path: Path, settings: MatchSettings, beat: Callable[[], None]) -> PhotoRow:
        if (path, settings) not in found_rows:
            found_rows[path, settings] = row_of(0, path, settings, beat)[1]
        return found_rows[path, settings]

    def rows(
        paths: tuple[Path, ...], settings: MatchSettings, _jobs: int, beat: Callable[[], None]
    ) -> Iterator[tuple[int, PhotoRow]]:
        yield from enumerate(row(path, settings, beat) for path in paths)

    monkeypatch.setattr(match_photos, "matched_rows", rows)
    application.store.change(pattern="10", switching_frequency=2e3, readout_time=12e-6)
    application.shell.pane("photo").many.choose_files(paths)
    application.shell.pane("photo").match_all()
    user.wait_until_idle()
    return paths


def shown_of(application: Application) -> set[str]:
    """Return the names of the photos that row, title, image, facts and match are of."""
    rows, view = application.view("photo").many.rows, application.view("photo")
    marked = [
        path.name
        for place, path in enumerate(rows.paths)
        if rows.data(rows.index(place, 0), Qt.ItemDataRole.BackgroundRole) is not None
    ]
    match = application.shell.pane("photo").matching.match
    of = [path.name for path in rows.paths if (r := rows.row_of(path)) and r.match is match]
    title = application.window.windowTitle().split(" – ")[0]  # noqa: RUF001 - a dash
    image = application.view("picture").shown_photo
    return {*marked, *of, title, image.path.name, view.facts.name.text()}


@pytest.mark.whole
def test_row_title_image_and_numbers_are_of_one_photo(
    application: Application, user: User, listed: tuple[Path, ...]
) -> None:
    application.open_photo(listed[0])
    user.wait_until_idle()
    assert shown_of(application) == {"one.jpg"}
    application.open_photo(listed[1])
    assert application.photos.choice.path == listed[1]
    assert shown_of(application) == {"one.jpg"}, "it is being read"
    user.wait_until_idle()
    assert shown_of(application) == {"two.jpg"}
    application.open_photo(listed[0].with_name("none.jpg"))
    user.wait_until_idle()
    assert shown_of(application) == {"two.jpg"}
    assert application.photos.choice.path == listed[1]


@pytest.mark.whole
def test_a_row_says_that_its_photo_was_matched_by_itself_since(
    application: Application, user: User, listed: tuple[Path, ...]
) -> None:
    rows = application.view("photo").many.rows
    application.open_photo(listed[1])
    user.wait_until_idle()
    before = rows.text(1, 1)
    assert "earlier" not in before
    application.view("photo").form.gamma.setChecked(True)
    application.shell.pane("photo").match()
    user.wait_until_idle()
    assert rows.text(1, 1) == f"{before}, earlier match"
    assert rows.text(0, 1) == before
    application.open_photo(listed[0])
    user.wait_until_idle()
    application.open_photo(listed[1])
    user.wait_until_idle()
    assert rows.text(1, 1) == before, "the row's own match is shown again"
