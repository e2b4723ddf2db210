"""Processes that match photos, where some of them end."""

from pathlib import Path

import pytest
from worker_calls import PickledJobs

import occ_model as occ
from occ_model.parallel import process_pool
from occ_model.photo.many.match_photos import match_by_workers
from occ_model.photo.many.row import MatchSettings
from occ_model.results.photo_table import PhotoRow

FILES = [(place, Path(name)) for place, name in enumerate(["a.png", "b.png", "c.png", "d.png"])]


def rows(monkeypatch: pytest.MonkeyPatch, *deadly: Path) -> dict[int, PhotoRow]:
    monkeypatch.setattr(process_pool, "ProcessPool", PickledJobs)
    monkeypatch.setattr(PickledJobs, "deadly", deadly)
    return dict(match_by_workers(FILES, MatchSettings(occ.Scene()), 2, lambda: None))


@pytest.mark.parametrize("deadly", [[0], [3], [1, 2], [0, 1, 2, 3]])
def test_a_photo_that_ends_its_process_is_a_row_and_no_other(
    monkeypatch: pytest.MonkeyPatch, deadly: list[int]
) -> None:
    found = rows(monkeypatch, *(FILES[place][1] for place in deadly))
    assert sorted(found) == [0, 1, 2, 3]
    ended = [place for place in range(4) if "ended each time" in found[place].note]
    assert ended == deadly
    assert all(one.verdict == "unreadable" for one in found.values())


def test_workers_that_can_do_nothing_leave_the_work_to_this_process(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with pytest.warns(RuntimeWarning, match="this process matches the photos alone"):
        found = rows(monkeypatch, Path(), *(path for _, path in FILES))
    assert sorted(found) == [0, 1, 2, 3]
    assert not any("ended" in one.note for one in found.values())
