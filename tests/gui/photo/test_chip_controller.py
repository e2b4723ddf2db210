"""Chips of a photo: read in the background, of the photo that is open."""

from dataclasses import replace

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo.chip_controller import ChipController
from occ_model.errors import MatchError
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.match import ChipReading

READING = ChipReading(np.array([1, 0], np.uint8), 9.0, 1.0, 0.0, Region(0, 9, 0, 60))


class Pane:
    def __init__(self) -> None:
        self.shown: list[ChipReading | None] = []

    def show_chips(self, reading: ChipReading | None) -> None:
        self.shown.append(reading)


def test_chips_of_each_photo_are_shown(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    monkeypatch.setattr(occ, "read_chips", lambda _photo, _region: READING)
    pane = Pane()
    controller = ChipController(pane)
    controller.show_photo(photo)
    qtbot.waitUntil(lambda: controller.runner.is_idle)
    assert pane.shown == [None, READING]
    controller.show_photo(None)
    assert pane.shown[-1] is None
    controller.stop()


def test_a_photo_without_chips_shows_none(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    def refuse(_photo: Photo, _region: Region | None) -> ChipReading:
        raise MatchError("No chips can be read.")

    monkeypatch.setattr(occ, "read_chips", refuse)
    pane = Pane()
    controller = ChipController(pane)
    controller.show_photo(replace(photo))
    qtbot.waitUntil(lambda: controller.runner.is_idle)
    assert pane.shown == [None, None]
    controller.stop()


def test_chips_of_a_photo_that_was_closed_are_not_shown(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    monkeypatch.setattr(occ, "read_chips", lambda _photo, _region: READING)
    pane = Pane()
    controller = ChipController(pane)
    controller.show_photo(photo)
    controller.show_photo(None)
    qtbot.waitUntil(lambda: controller.runner.is_idle)
    assert pane.shown == [None, None]
    controller.stop()


def test_chips_of_another_part_replace_those_of_the_whole_photo(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    part = Region(0, 9, 10, 60)
    of_part = replace(READING, start=10.0)
    monkeypatch.setattr(
        occ, "read_chips", lambda _photo, region: READING if region is None else of_part
    )
    pane = Pane()
    controller = ChipController(pane)
    controller.show_photo(photo)
    controller.set_region(part)
    qtbot.waitUntil(lambda: controller.runner.is_idle)
    assert READING not in pane.shown
    assert pane.shown[-1] is of_part
    controller.stop()
