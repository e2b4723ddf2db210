"""What a soak does to a window in several steps: photos that are matched, and files to keep."""

import random
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from gui.kinds import not_none
from gui.mouse import turn_wheel, views_of
from model.plugins.installed_package import install
from PIL import Image
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_model import plugins
from occ_model.receiver import decoders
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene

PLUGINS = """
import occ_model as occ

def read(signal, scene):
    bits = scene.transmitter.payload_bits
    return occ.read_payload(occ.DecodeResult("reads", signal=signal, chips=bits), scene)

def fail(signal, scene):
    raise ValueError("not today")

reads = occ.Decoder("reads", "Reads", read)
fails = occ.Decoder("fails", "Fails", fail)
"""

_PHOTOS = 3
_MOST_STEPS = 20
"""More than any lesson has."""

_LONG_WAIT_MS = 600_000
"""Processes that match photos take a while to start on a busy machine."""


def install_plugins(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let there be a decoder of another package that works, and one that fails."""
    offered = {name: f"soaked:{name}" for name in ("reads", "fails")}
    install(folder, "soaked", {plugins.DECODERS: offered}, PLUGINS)
    monkeypatch.syspath_prepend(folder)
    caches = (plugins._found, decoders._plugin)
    for cache in caches:
        cache.cache_clear()
    yield
    for cache in caches:
        cache.cache_clear()


class Errands:
    """Runs errands at a window, each by the way that a user has for it."""

    def __init__(
        self, application: Application, qtbot: QtBot, choose_path: Callable[[Path], None],
        folder: Path, scene: Scene, chance: random.Random,
    ) -> None:  # fmt: skip
        self._application, self._qtbot = application, qtbot
        self._choose_path, self._folder = choose_path, folder
        self._scene, self._random = scene, chance
        self.deeds: dict[Callable[[], object], int] = {
            self.turn_the_wheel: 40,
            self.choose_a_decoder: 20,
            self.match_the_photo: 3,
            self.find_the_lamps: 6,
            self.choose_what_is_matched: 12,
            self.match_several: 2,
            self.keep_the_film: 3,
            self.write_a_report: 2,
            self.write_for_a_board: 3,
        }

    def come_home(self) -> None:
        """Put away what these errands leave open."""
        self._application.view("photo").many.close_table.click()
        self._application.view("decode").decoders.setCurrentIndex(0)
        self._close_the_board()

    def _trigger(self, name: str) -> None:
        self._application.window.actions_by_name[name].trigger()

    def _photos(self) -> list[Path]:
        paths = [self._folder / f"photo {number}.png" for number in range(_PHOTOS)]
        if not paths[-1].exists():
            for number, path in enumerate(paths):
                seen = self._scene.replace(start_time=number * 1e-4)
                Image.fromarray(occ.render(seen).image).save(path)
        return paths

    def _settle(self) -> None:
        """Wait until nothing is at work; a photo may be read only then."""
        self._qtbot.wait(1)
        self._qtbot.waitUntil(lambda: self._application.is_idle, timeout=_LONG_WAIT_MS)

    def _open_a_photo(self) -> None:
        self._application.window.dropped.emit([self._random.choice(self._photos())])
        self._settle()

    def turn_the_wheel(self) -> None:
        seen = [view for view in views_of(self._application.window) if view.isVisible()]
        if seen:  # some tasks show none
            turn_wheel(self._random.choice(seen), self._random.choice([-9, -3, -1, 1, 3, 9]))

    def choose_a_decoder(self) -> None:
        tabs = self._application.view("decode").decoders
        tabs.setCurrentIndex(self._random.randrange(tabs.count()))

    def match_the_photo(self) -> None:
        self._open_a_photo()
        self._trigger("match")
        if self._random.random() < 0.7:
            self._settle()
        self._trigger("apply_match")

    def find_the_lamps(self) -> None:
        self._open_a_photo()
        self._application.view("photo").lamps.search.click()
        if self._random.random() < 0.7:
            self._settle()

    def choose_what_is_matched(self) -> None:
        form, outlines = (
            self._application.view("photo").lamps,
            self._application.shell.pane("photo").outlines,
        )
        if rows := form.table.rowCount():
            form.table.selectRow(self._random.randrange(rows))
        elif self._random.random() < 0.5:
            form.by_hand.click()
        else:
            top, left = self._random.randrange(90), self._random.randrange(900)
            outlines.drawn.emit(Region(top, top + 60, left, left + 300))
        if self._random.random() < 0.3:
            form.whole.click()

    def match_several(self) -> None:
        view = self._application.view("photo").many
        self._application.window.dropped.emit(self._photos())
        self._settle()
        view.start.click()
        if self._random.random() < 0.3:
            self._qtbot.wait(300)
            view.work.cancel.click()
            return
        self._settle()
        self._choose_path(self._folder / "photos.csv")
        self._random.choice([view.save, view.copy]).click()
        view.table.clicked.emit(view.rows.index(self._random.randrange(_PHOTOS), 0))

    def keep_the_film(self) -> None:
        form = self._application.video.wiring.view.form
        form.count.setValue(3)
        self._choose_path(self._folder / "kept.mkv")
        form.save.click()
        if self._random.random() < 0.3:
            form.saving.cancel.click()

    def write_a_report(self) -> None:
        guide = self._application.shell.pane("lessons").view
        if not guide.list.choices:
            self._trigger("lessons")
            self._qtbot.waitUntil(lambda: bool(guide.list.choices))
        guide.step.all.click()
        self._random.choice(guide.list.choices).click()
        for _ in range(_MOST_STEPS):
            if guide.step.isVisibleTo(guide):
                guide.step.next.click()
        self._choose_path(self._folder / f"report.{self._random.choice(['pdf', 'md', 'png'])}")
        guide.end.report.click()
        self._settle()

    def write_for_a_board(self) -> None:
        self._trigger("transmitter")
        transmitter = not_none(self._application.shell.made_pane("transmitter"))
        dialog = not_none(transmitter.dialog)
        dialog.board.setCurrentIndex(self._random.randrange(dialog.board.count()))
        dialog.board.chosen.emit(dialog.board.key())
        boards = self._folder / "boards" / str(self._random.random())
        boards.mkdir(parents=True)
        self._choose_path(boards)
        dialog.save.click()
        self._settle()
        self._close_the_board()

    def _close_the_board(self) -> None:
        transmitter = self._application.shell.made_pane("transmitter")
        if transmitter is not None and transmitter.dialog is not None:
            transmitter.dialog.reject()
