"""Real photographs of lamps by other people are read surely, and never surely wrong."""

from collections.abc import Sequence
from pathlib import Path

import pytest
from photo_world.real_views import Answer, Truth, answers, truths

pytestmark = pytest.mark.photos


@pytest.fixture(scope="module")
def views(photos: Path) -> Sequence[Truth]:
    folder = photos / "real"
    if not folder.is_dir():
        pytest.skip("the photographs of other people are not here")
    return truths(folder)


def sure_and_right(views: Sequence[Truth], group: str) -> list[Answer]:
    """Return the sure answers about a group of photographs, none of which is wrong."""
    sure = []
    for truth in views:
        if truth.group == group:
            for answer in answers(truth):
                if answer.verdict == "sure":
                    assert not answer.is_wrong(truth.tolerance), (truth.file.name, answer.line())
                    sure.append(answer)
    return sure


@pytest.mark.parametrize(
    ("group", "least"),
    [
        ("lamps", 13),
        ("lasers", 4),
        pytest.param("rooms", 24, marks=pytest.mark.whole),
        pytest.param("cameras", 2, marks=pytest.mark.whole),
    ],
)
def test_lamps_are_read_surely(views: Sequence[Truth], group: str, least: int) -> None:
    assert len(sure_and_right(views, group)) >= least


@pytest.mark.whole
def test_nothing_is_sure_where_no_lamp_is(views: Sequence[Truth]) -> None:
    assert sure_and_right(views, "none") == []
