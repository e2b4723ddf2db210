"""Real photographs of lamps by other people are read surely, and never surely wrong."""

from collections.abc import Sequence
from pathlib import Path

import pytest
from photo_world.real_views import Answer, KnownPhoto, load_known_photos, read_answers

pytestmark = pytest.mark.photos


@pytest.fixture(scope="module")
def known_photos(photos: Path) -> Sequence[KnownPhoto]:
    folder = photos / "real"
    if not folder.is_dir():
        pytest.skip("the photographs of other people are not here")
    return load_known_photos(folder)


def sure_and_right(known_photos: Sequence[KnownPhoto], group: str) -> list[Answer]:
    """Return the sure answers about a group of photographs, none of which is wrong."""
    sure = []
    for known in known_photos:
        if known.group == group:
            for answer in read_answers(known):
                if answer.verdict == "sure":
                    assert not answer.is_wrong(known.tolerance), (known.file.name, answer.line())
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
def test_lamps_are_read_surely(known_photos: Sequence[KnownPhoto], group: str, least: int) -> None:
    assert len(sure_and_right(known_photos, group)) >= least


@pytest.mark.whole
def test_nothing_is_sure_where_no_lamp_is(known_photos: Sequence[KnownPhoto]) -> None:
    assert sure_and_right(known_photos, "none") == []
