"""Chips and lamps of a photo: worked out in the background, of the photo that is open."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest
from gui.photo.photo_bench import PhotoBench
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo.part_edits import PartEdits
from occ_gui.photo.photo_work import chip_reading, lamp_search
from occ_gui.shell.work import Work
from occ_model.errors import MatchError
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import ChipReading

READING = ChipReading(np.array([1, 0], np.uint8), 9.0, 1.0, 0.0, Region(0, 9, 0, 60))


class Bench(PhotoBench):
    def __init__(self, qtbot: QtBot) -> None:
        super().__init__()
        self.work: Work[object, object] = chip_reading(self.store, self.board)  # type: ignore[assignment]
        self.shown: list[ChipReading | None] = []
        self.chips = self.board.select(lambda results: results.chips)
        self.chips.changed.connect(self.shown.append)
        self._qtbot = qtbot

    def wait(self) -> None:
        self._qtbot.waitUntil(lambda: self.work.task.is_idle)


@pytest.fixture
def bench(qtbot: QtBot) -> Iterator[Bench]:
    bench = Bench(qtbot)
    yield bench
    bench.work.task.stop()


@pytest.fixture
def read(monkeypatch: pytest.MonkeyPatch) -> Callable[[ChipReading], None]:
    def give(reading: ChipReading) -> None:
        monkeypatch.setattr(occ, "read_chips", lambda _photo, _region: reading)

    return give


def test_chips_of_each_photo_are_shown(
    photo: Photo, read: Callable[[ChipReading], None], bench: Bench
) -> None:
    read(READING)
    bench.show_photo(photo)
    assert bench.shown == []
    bench.wait()
    assert bench.shown == [READING]
    bench.show_photo(replace(photo))
    assert bench.shown[-1] is None
    bench.wait()
    assert bench.shown[-1] is READING
    bench.show_photo(None)
    assert bench.shown[-1] is None


def test_a_photo_without_chips_shows_none(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, bench: Bench
) -> None:
    def refuse(_photo: Photo, _region: Region | None) -> ChipReading:
        raise MatchError("No chips can be read.")

    monkeypatch.setattr(occ, "read_chips", refuse)
    bench.show_photo(photo)
    bench.wait()
    assert bench.shown == []


def test_chips_of_a_photo_that_was_closed_are_not_shown(
    photo: Photo, read: Callable[[ChipReading], None], bench: Bench, qtbot: QtBot
) -> None:
    read(READING)
    bench.show_photo(photo)
    bench.show_photo(None)
    bench.wait()
    qtbot.wait(20)
    assert bench.shown == []


def test_chips_of_another_part_replace_those_of_the_whole_photo(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, bench: Bench
) -> None:
    of_part = replace(READING, start=10.0)
    monkeypatch.setattr(
        occ, "read_chips", lambda _photo, region: READING if region is None else of_part
    )
    bench.show_photo(photo)
    PartEdits(bench.store, bench.board).draw(Region(0, 9, 10, 60))
    bench.wait()
    assert bench.shown == [of_part]


def test_lamps_are_found_when_asked_for_and_come_back_with_what_was_set(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, bench: Bench, qtbot: QtBot
) -> None:
    """As at the end of a lesson; asked for again, they are searched again."""
    searched: list[Photo] = []

    def find(shown: Photo, _report: object) -> tuple[Lamp, ...]:
        searched.append(shown)
        return (Lamp(Region(0, 9, 0, 20), np.array([[0, 9, 0, 20]]), 200.0, modulated=False),)

    monkeypatch.setattr(occ, "find_lamps", find)
    bench.work.task.stop()
    bench.work = lamp_search(bench.store, bench.board)  # type: ignore[assignment]
    parts = PartEdits(bench.store, bench.board)
    bench.show_photo(photo)
    assert searched == []
    parts.find()
    bench.wait()
    users, opened = bench.store.workspace, bench.board.results.opened
    (lamp,) = bench.board.results.lamps
    bench.show_photo(replace(photo))
    assert bench.board.results.lamps == ()
    bench.store.put(users)
    bench.board.put(replace(bench.board.results, opened=opened))
    assert bench.board.results.lamps == (lamp,)
    assert searched == [photo]
    parts.find()
    bench.wait()
    assert searched == [photo, photo]
