"""The features of the window, declared in the order of the view menu."""

from typing import Any

from occ_gui.app import panes, services
from occ_gui.app.parts import Parts
from occ_gui.files.file_controller import sample_photos
from occ_gui.photo.window_actions import WindowActions
from occ_gui.shell.feature import Feature
from occ_gui.window.menus import words_of
from occ_model.scene.from_text import DEFAULT_PRESET
from occ_model.scene.presets import load_preset
from occ_model.version import __version__


def features(parts: Parts) -> tuple[Feature[Any], ...]:
    scenes, shell, window = parts.scene_store, parts.shell, parts.window
    preferences, store = parts.preferences, parts.scene_store.store

    def current_pane() -> str:
        return parts.current_pane.name

    return (
        panes.decoding(store),
        panes.photo(
            scenes,
            parts.photos,
            lambda: shell.pane("picture").view,
            parts.results_store,
            _actions_of_photo(parts),
        ),
        panes.profile(store, parts.results_store, parts.describe_photo),
        panes.photos(lambda: shell.pane("photo")),
        panes.accuracy(scenes, parts.simulation),
        panes.detection_map(scenes, parts.background_rates),
        panes.bands(scenes),
        panes.equations(scenes, lambda: shell.pane("profile").view.plot),
        panes.spectrum(),
        panes.colour(),
        panes.compare(parts.pins),
        panes.lessons(scenes, parts.results_store, parts.controls, preferences),
        panes.video(scenes, parts.results_store),
        panes.room(store),
        panes.bench(scenes, parts.background_rates),
        services.export(window, shell, parts.present_results, preferences, current_pane, store),
        services.animation(window, scenes, preferences, window.animation_bar),
        services.transmitter(window, scenes, preferences),
        services.camera(window, scenes, preferences),
        services.manual(window, shell, current_pane),
        services.welcome(window, shell, preferences, parts.files),
        _entries(parts),
    )


def _actions_of_photo(parts: Parts) -> WindowActions:
    return WindowActions(
        ask_for_photo=parts.files.ask_for_photo,
        samples=lambda: {words_of(path.stem): path for path in sample_photos()},
        open_sample=parts.files.open_sample,
        edit_scene=parts.editor.edit,
        save_match=parts.presets.ask_to_save_match,
        save_table=parts.files.ask_to_save_table,
    )


def _match(parts: Parts) -> None:
    parts.window.bring_to_front("photo")
    parts.shell.pane("photo").match()


def _entries(parts: Parts) -> Feature[None]:
    """Declare the entries of the menus that belong to no pane."""
    files, options, window = parts.files, parts.options, parts.window
    return Feature(
        name="entries",
        actions={
            "open_photo": files.ask_for_photo,
            "close_photo": parts.photos.close,
            "open_film": files.ask_for_film,
            "close_film": parts.video.close,
            "open_scene": files.ask_for_scene,
            "save_scene": parts.document.save,
            "save_scene_as": files.ask_to_save_scene,
            "save_picture": files.ask_to_save_picture,
            "save_film": files.ask_to_save_film,
            "reset_scene": lambda: parts.scene_store.begin(
                load_preset(DEFAULT_PRESET), "reset of the scene"
            ),
            "match": lambda: _match(parts),
            "delete_preset": parts.presets.ask_to_delete,
            "fit": lambda: _fit(parts),
            "text_larger": options.text_size.enlarge,
            "text_smaller": options.text_size.reduce,
            "text_normal": options.text_size.reset,
            "reset_layout": window.modes.reset,
            "lessons": lambda: window.bring_to_front("lessons"),
            "report": lambda: _show_report(parts),
            "about": lambda: _show_about(parts),
            "shortcuts": lambda: _show_shortcuts(parts),
            "palette": lambda: _show_palette(parts),
        },
    )


def _fit(parts: Parts) -> None:
    parts.story.rows.fit()
    if (pane := parts.shell.find_pane("picture")) is not None:
        pane.view.fit()


# Rarely used features are imported when needed: they would slow down the start.


def _show_report(parts: Parts) -> None:
    from occ_gui.app.report import report_text, show_report

    messages = parts.error_reports.last_messages.lines
    text = report_text(parts.scene_store.scene, parts.scene_store.settings.settings, messages)
    show_report(parts.window, text)


def _show_about(parts: Parts) -> None:
    from PySide6.QtWidgets import QMessageBox

    text = (
        f"Optical Camera Communication {__version__}\n\nSimulates the pictures that a "
        "rolling-shutter camera takes of a blinking LED panel, and decodes the code in them."
    )
    QMessageBox.about(parts.window, "About", text)


def _show_shortcuts(parts: Parts) -> None:
    from occ_gui.window.command_lists import ShortcutSheet, shortcuts_of

    sheet = ShortcutSheet(shortcuts_of(parts.window.menuBar()), parts.window)
    sheet.exec()
    sheet.deleteLater()


def _show_palette(parts: Parts) -> None:
    from occ_gui.window.command_lists import CommandPalette, commands_of

    window = parts.window
    commands = commands_of(window.menuBar(), parts.controls, window.bring_to_front)
    palette = CommandPalette(commands, window)
    chosen = palette.chosen if palette.exec() else None
    palette.deleteLater()
    if chosen is not None:
        chosen.run()
