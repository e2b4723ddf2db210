"""What a soak does to a window: random things, each by the way that a user has for it."""

import random
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import damaged_photos
import pytest
from film_source import FilmSource
from gui.mouse import turn_wheel, views_of
from hard_cases.fuzzing.mutations import encode_text, mutate_text, random_quantity, random_text
from hard_cases.fuzzing.target import LONGEST_SENTENCE
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog, QLineEdit
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.app.story_wiring import story_menu
from occ_gui.core.store import NO_GESTURE
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.files.file_controller import sample_photos
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.scene.scene_store import new_gesture
from occ_gui.values.choices import OVERLAYS, THEMES
from occ_gui.video.wiring import VideoWiring
from occ_model.effects.registry import NAMES
from occ_model.results.decoding import Region
from occ_model.results.teaching import LoadedLessons
from occ_model.results.video import VideoFrame
from occ_model.scene.parameter_kinds import Choice, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.provenance import ENDINGS
from occ_model.scene.scene import Scene
from occ_model.teaching.lessons import lessons

_HEAVY = ("rows", "columns", "point_spread", "distance", "panel_width", "panel_height")
"""What would make pictures so large, or blurs so wide, that a soak is about them alone."""

_PATIENCE_MS = 600_000
"""All figures in all formats take some seconds; at the lowest priority they take minutes."""


_FIRST_SIZE = (1280, 800)

_NOTCHES = 100
"""Of the wheel, from one end to the other and farther."""

_PHOTOS = 3
_MOST_STEPS = 20
"""More than any lesson has."""


def smaller(scene: Scene) -> Scene:
    """Return a scene whose picture takes a few milliseconds."""
    return scene.replace(rows=150, columns=1200)


def smaller_lessons() -> LoadedLessons:
    """Return the lessons with pictures that take a few milliseconds."""
    return LoadedLessons(
        tuple(
            replace(each, steps=tuple(replace(s, scene=smaller(s.scene)) for s in each.steps))
            for each in lessons().lessons
        )
    )


@cache
def short_film() -> list[VideoFrame]:
    return list(occ.render_video(smaller(occ.load_preset("phone-68us")), 4))


class FileDialogs:
    """Answers every dialog that asks for a path with the path that was set last."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.path = Path()
        for name in ("getOpenFileName", "getSaveFileName"):
            monkeypatch.setattr(QFileDialog, name, lambda *_: (str(self.path), ""))
        monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: ([str(self.path)], ""))
        monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(self.path))

    def answer_with(self, path: Path) -> None:
        self.path = path


class Monkey:
    """Does random things to a window, and answers its dialogs in place of a user."""

    def __init__(
        self, application: Application, qtbot: QtBot, dialogs: FileDialogs, folder: Path, seed: int
    ) -> None:
        self._application = application
        self._qtbot = qtbot
        self._dialogs, self._folder = dialogs, folder
        self._random = random.Random(seed)
        self._gesture = new_gesture()
        self._scene = smaller(occ.load_preset("phone-68us"))
        at, chance, scenes = application, self._random, application.scene_store
        undo_stack = scenes.undo_stack
        # In an order in which each action finds what it needs the first time.
        self._actions: dict[Callable[[], object], int] = {
            self.move_a_slider: 1200,
            self.choose_a_word: 80,
            lambda: scenes.change(code=chance.randrange(1024), bits=10): 80,
            lambda: chance.choice([undo_stack.undo, undo_stack.redo])(): 120,
            self.load_a_preset: 60,
            self.force_an_effect: 40,
            lambda: at.settings.set_tolerance(10.0 ** chance.uniform(-1.0, 2.0)): 40,
            lambda: at.files.open_photo(chance.choice(sample_photos())): 20,
            lambda: at.view("picture").set_mode(chance.choice(OVERLAYS)): 60,
            self.choose_a_task: 30,
            self.press_a_tool: 40,
            self.lay_the_photo_over: 20,
            self.toggle_a_dock: 60,
            self.ask_for_what_cannot_be: 40,
            self.type_anything: 40,
            self.drop_what_is_damaged: 40,
            self.resize: 20,
            self.zoom_every_plot: 4,
            self.hold_the_brightness: 20,
            partial(self._trigger, "slider_strips"): 10,
            self.run_a_slider: 10,
            self.measure_between_columns: 10,
            self.use_a_context_menu: 20,
            self.go_to_a_limit: 6,
            lambda: self._trigger(f"pin_{chance.choice('ab')}"): 20,
            lambda: self._trigger(f"go_to_{chance.choice('ab')}"): 10,
            partial(self._trigger, "clear_pins"): 6,
            self.choose_a_lesson: 10,
            self.step_on_or_back: 20,
            self.leave_the_lesson: 6,
            lambda: self._trigger(f"theme_{chance.choice(THEMES)}"): 6,
            self.save_the_scene: 10,
            self.open_the_saved_scene: 10,
            self.export_a_figure: 12,
            self.copy_a_figure: 6,
            self.export_all: 1,
            self.open_an_exported_figure: 10,
            self.close_the_photo: 20,
            partial(self._trigger, "reset_layout"): 8,
            self.open_a_film: 6,
            self.read_or_stop: 10,
            lambda: self._films.view.transport.play.click(): 20,
            self.seek_a_frame: 30,
            self.record_otherwise: 10,
            self.film_live: 6,
            self.close_the_film: 10,
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
        self._never_done = list(self._actions)

    def check_message(self, text: str) -> None:
        """Check that the status line shows one printable line of bounded length."""
        assert text.isprintable(), f"not one printable line: {text!r}"
        assert len(text) <= LONGEST_SENTENCE, f"{len(text)} characters"

    def act(self) -> None:
        """Do one of the actions: first each of them once, then random ones."""
        if self._never_done:
            self._never_done.pop(0)()
            return
        (action,) = self._random.choices(list(self._actions), list(self._actions.values()))
        action()

    def wait(self) -> None:
        """Wait until all that was asked for is shown and written."""
        self._qtbot.wait(1)  # also where nothing has to be simulated: events wait, too
        self._qtbot.waitUntil(lambda: self._application.is_idle, timeout=_PATIENCE_MS)

    def close_everything(self, scene: Scene) -> None:
        """Close everything, so that the memory can be compared with that of another time."""
        self.wait()  # what is still being copied would be there again
        settings = self._application.settings
        settings.set_tolerance(FIRST_SETTINGS.tolerance)
        for effect in NAMES:
            self._application.scene_store.force(effect, None)
        self._application.scene_store.put(scene, "home")
        self._show_a_photo_everywhere()
        self.close_the_photo()
        self._films.live.stop_filming()
        self._films.films.player.pause()
        self._films.films.close()
        self._application.view("photo").many.close_table.click()
        self._application.view("decode").decoders.setCurrentIndex(0)
        self._close_the_board()
        self._trigger("clear_pins")
        self.leave_the_lesson()
        self._application.options.theme.choose(THEMES[0])
        self._trigger("reset_layout")
        self._application.window.resize(*_FIRST_SIZE)
        QGuiApplication.clipboard().clear()
        self.wait()

    def _show_a_photo_everywhere(self) -> None:
        """Let all panes keep the same photo: each keeps what it has shown last."""
        self._application.files.open_photo(sample_photos()[0])
        self.wait()
        for mode in reversed(OVERLAYS):
            self._trigger(f"show_{mode}")
            self.wait()

    def _trigger(self, name: str) -> None:
        self._application.window.actions_by_name[name].trigger()

    def move_a_slider(self) -> None:
        names = [n for n, p in PARAMETERS.items() if isinstance(p, Quantity) and n not in _HEAVY]
        declared = PARAMETERS[self._random.choice(names)]
        assert isinstance(declared, Quantity)
        if self._random.random() < 0.3:
            self._gesture = new_gesture()
        value = declared.at(self._random.random())
        self._application.scene_store.change(self._gesture, **{declared.name: value})

    def choose_a_word(self) -> None:
        names = [n for n, p in PARAMETERS.items() if isinstance(p, Choice)]
        declared = PARAMETERS[self._random.choice(names)]
        assert isinstance(declared, Choice)
        word = self._random.choice(declared.choices)
        self._application.scene_store.change(NO_GESTURE, **{declared.name: word})

    def load_a_preset(self) -> None:
        scene = occ.load_preset(self._random.choice(occ.presets()))
        self._application.scene_store.put(smaller(scene), "preset")

    def force_an_effect(self) -> None:
        included = self._random.choice([True, False, None, None])
        self._application.scene_store.force(self._random.choice(NAMES), included)

    def close_the_photo(self) -> None:
        self._application.photos.close()

    def choose_a_task(self) -> None:
        tabs = self._application.window.toolbar.modes
        tabs.setCurrentIndex(self._random.randrange(tabs.count()))

    def press_a_tool(self) -> None:
        buttons = self._application.window.toolbar.buttons
        # Those that open a menu or a dialog would wait for somebody.
        quiet = [name for name, button in buttons.items() if button.menu() is None]
        buttons[self._random.choice([name for name in quiet if name != "open_photo"])].click()

    def lay_the_photo_over(self) -> None:
        image = self._application.view("picture")
        self._trigger(f"show_{self._random.choice(OVERLAYS)}")
        image.opacity.setValue(self._random.randrange(101))
        image.gain.setCurrentIndex(self._random.randrange(image.gain.count()))
        image.gain.chosen.emit(image.gain.key())

    def toggle_a_dock(self) -> None:
        docks = list(self._application.window.docks.values())
        self._random.choice(docks).toggleViewAction().trigger()

    @property
    def _films(self) -> VideoWiring:
        return self._application.video.wiring

    def open_a_film(self) -> None:
        path = self._folder / "film.gif"
        if not path.exists():
            pictures = [Image.fromarray(frame.image) for frame in short_film()]
            pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=40)
        self._dialogs.answer_with(path)
        self._trigger("open_film")

    def close_the_film(self) -> None:
        self._trigger("close_film")
        self._films.close()

    def read_or_stop(self) -> None:
        # A sample's scene has large pictures: many of them would take longer than is waited.
        self._films.view.form.count.setValue(self._random.randrange(2, 5))
        self._films.view.bar.read.click()

    def seek_a_frame(self) -> None:
        keys = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Home, Qt.Key.Key_End)
        self._qtbot.keyClick(self._films.view.timeline, self._random.choice(keys))

    def record_otherwise(self) -> None:
        form = self._films.view.form
        form.count.setValue(self._random.randrange(2, 12))
        form.fields["frame_rate"].edited.emit(self._random.choice([1.0, 24.0, 1000.0]))

    def film_live(self) -> None:
        self._films.live.start(FilmSource(short_film() * 20, "Stand-in", in_real_time=False))
        self._qtbot.wait(50)

    def ask_for_what_cannot_be(self) -> None:
        self._application.scene_store.change(exposure_time=-1.0)
        self._application.settings.set_tolerance(float("nan"))
        self._application.files.open_photo(Path("/nowhere/photo.png"))

    def type_anything(self) -> None:
        """Type anything in some fields, and leave each."""
        fields = self._application.window.findChildren(QLineEdit)
        enabled = [field for field in fields if field.isEnabled() and field.isVisible()]
        for field in self._random.sample(enabled, min(3, len(enabled))):
            make = random_quantity if self._random.random() < 0.7 else random_text
            field.setText(make(self._random).encode("utf-8", "replace").decode())
            field.textEdited.emit(field.text())
            field.returnPressed.emit()
            field.editingFinished.emit()

    def drop_what_is_damaged(self) -> None:
        """Drop a damaged scene, or a photo that is damaged or odd."""
        scene = mutate_text(self._random, self._scene.to_toml())
        make = self._random.choice((damaged_photos.make_damaged, damaged_photos.make_unusual))
        path = self._folder / self._random.choice(("a\x1b[31m", "é" * 60, "own.toml", "own.png"))
        path.write_bytes(
            encode_text(self._random, scene)
            if self._random.random() < 0.3
            else make(self._random.getrandbits(32))[1]
        )
        self._application.window.dropped.emit([path])

    def resize(self) -> None:
        width = self._random.randrange(1000, 1600)
        self._application.window.resize(width, self._random.randrange(700, 1000))

    def zoom_every_plot(self) -> None:
        for towards in self._random.choice([(-1, 1), (1, -1)]):
            for view in views_of(self._application.window):
                turn_wheel(view, towards * _NOTCHES)
            self.wait()  # until it is drawn

    def hold_the_brightness(self) -> None:
        self._trigger("hold_brightness")
        slider = self._application.controls.main_rows()["exposure_time"].slider
        slider.setValue(self._random.randint(slider.minimum(), slider.maximum()))

    def run_a_slider(self) -> None:
        panels = self._application.controls.panels.values()
        buttons = [button for panel in panels for button in panel.play_buttons.values()]
        played = self._random.choice(buttons)
        played.click()
        self._qtbot.wait(60)
        played.click()

    def measure_between_columns(self) -> None:
        self._trigger("measure")
        crosshair = self._application.story.rows.crosshair
        for place in (0, 1):
            column = self._random.uniform(-50.0, crosshair.columns + 50.0)
            crosshair.cursors.move(place, column, crosshair.columns)
        crosshair.choose(self._random.uniform(-50.0, crosshair.columns + 50.0))

    def use_a_context_menu(self) -> None:
        player = self._application.controls.player
        name = self._random.choice([*self._application.controls.main_rows()])
        # Not opened: the platform that draws no window warns that it cannot grab the keyboard.
        for menu in (story_menu(self._application), player.menu_of(name)):
            self._dialogs.answer_with(self._folder / "from-a-menu.png")
            entries = [entry for entry in menu.actions() if entry.isEnabled() and entry.text()]
            self._random.choice(entries[:-1]).trigger()
            menu.deleteLater()

    def go_to_a_limit(self) -> None:
        cards = self._application.shell.pane("map").view.cards.cards
        self._random.choice([*cards.values()]).go.click()

    def _guide(self) -> LessonView:
        guide = self._application.shell.pane("lessons").view
        if not guide.list.choices:
            self._trigger("lessons")
            self._qtbot.waitUntil(lambda: bool(guide.list.choices))
        return guide

    def choose_a_lesson(self) -> None:
        guide = self._guide()
        guide.step.all_lessons.click()
        self._random.choice(guide.list.choices).click()

    def step_on_or_back(self) -> None:
        guide = self._guide()
        if not guide.step.next.isVisibleTo(guide):
            guide.list.choices[0].click()
        step = guide.step
        buttons = (step.next, step.next, step.back, step.reset, step.reveal, step.control)
        self._random.choice(buttons).click()

    def leave_the_lesson(self) -> None:
        self._guide().step.all_lessons.click()

    def save_the_scene(self) -> None:
        self._dialogs.answer_with(self._folder / "scene.toml")
        self._trigger(self._random.choice(["save_scene", "save_scene_as"]))

    def open_the_saved_scene(self) -> None:
        self._dialogs.answer_with(self._folder / "scene.toml")
        self._trigger("open_scene")

    def export_a_figure(self) -> None:
        name = self._random.choice(list(self._application.shell.figures))
        self._dialogs.answer_with(self._folder / f"{name}{self._random.choice(ENDINGS)}")
        self._trigger(f"export_{name}")

    def copy_a_figure(self) -> None:
        if self._random.random() < 0.5:
            self._trigger("copy_figure")
        else:
            titles = self._application.shell.figures
            self._application.shell.pane("export").copy(self._random.choice(list(titles)))

    def export_all(self) -> None:
        self._dialogs.answer_with(self._folder / "all")
        self._trigger("export_all")

    def open_an_exported_figure(self) -> None:
        self.wait()
        path = self._random.choice(sorted((self._folder / "all").iterdir()))
        if self._random.random() < 0.5:
            self._dialogs.answer_with(path)
            self._trigger("open_scene")
        else:
            self._application.window.dropped.emit([path])

    def _photos(self) -> list[Path]:
        paths = [self._folder / f"photo {number}.png" for number in range(_PHOTOS)]
        if not paths[-1].exists():
            for number, path in enumerate(paths):
                seen = self._scene.replace(start_time=number * 1e-4)
                Image.fromarray(occ.render(seen).image).save(path)
        return paths

    def _open_a_photo(self) -> None:
        self._application.window.dropped.emit([self._random.choice(self._photos())])
        self.wait()

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
            self.wait()
        self._trigger("apply_match")

    def find_the_lamps(self) -> None:
        self._open_a_photo()
        self._application.view("photo").lamps.search.click()
        if self._random.random() < 0.7:
            self.wait()

    def choose_what_is_matched(self) -> None:
        form = self._application.view("photo").lamps
        outlines = self._application.shell.pane("photo").outlines
        if rows := form.table.rowCount():
            form.table.selectRow(self._random.randrange(rows))
        elif self._random.random() < 0.5:
            form.by_hand.click()
        else:
            top, left = self._random.randrange(90), self._random.randrange(900)
            outlines.drawn.emit(Region(top, top + 60, left, left + 300))
        if self._random.random() < 0.3:
            form.whole_photo.click()

    def match_several(self) -> None:
        view = self._application.view("photo").many
        self._application.window.dropped.emit(self._photos())
        self.wait()
        view.start.click()
        if self._random.random() < 0.3:
            self._qtbot.wait(300)
            view.work.cancel.click()
            return
        self.wait()
        self._dialogs.answer_with(self._folder / "photos.csv")
        self._random.choice([view.save, view.copy]).click()
        view.table.clicked.emit(view.rows.index(self._random.randrange(_PHOTOS), 0))

    def keep_the_film(self) -> None:
        form = self._application.video.wiring.view.form
        form.count.setValue(3)
        self._dialogs.answer_with(self._folder / "kept.mkv")
        form.save.click()
        if self._random.random() < 0.3:
            form.saving.cancel.click()

    def write_a_report(self) -> None:
        self.choose_a_lesson()
        guide = self._guide()
        for _ in range(_MOST_STEPS):
            if guide.step.isVisibleTo(guide):
                guide.step.next.click()
        self._dialogs.answer_with(
            self._folder / f"report.{self._random.choice(['pdf', 'md', 'png'])}"
        )
        guide.end.report.click()
        self.wait()

    def write_for_a_board(self) -> None:
        self._trigger("transmitter")
        transmitter = self._application.shell.find_pane("transmitter")
        dialog = transmitter.dialog
        dialog.board.setCurrentIndex(self._random.randrange(dialog.board.count()))
        dialog.board.chosen.emit(dialog.board.key())
        boards = self._folder / "boards" / str(self._random.random())
        boards.mkdir(parents=True)
        self._dialogs.answer_with(boards)
        dialog.save.click()
        self.wait()
        self._close_the_board()

    def _close_the_board(self) -> None:
        transmitter = self._application.shell.find_pane("transmitter")
        if transmitter is not None and transmitter.dialog is not None:
            transmitter.dialog.reject()
