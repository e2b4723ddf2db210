"""Declarations of the window's services, which have no pane; their modules are imported late."""

from collections.abc import Callable
from typing import Any

from PySide6.QtWidgets import QMainWindow, QWidget

from occ_gui.core.store import Store
from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, defer
from occ_gui.shell.shell import Shell
from occ_gui.simulation.present_results import PresentResults
from occ_gui.widgets.work_bar import WorkBar
from occ_gui.window.main_window import MainWindow


def export(
    window: QWidget,
    shell: Shell,
    present: PresentResults,
    preferences: Preferences,
    current_pane: Callable[[], str],
    store: Store,
) -> Feature[Any]:
    return Feature(
        name="export",
        make=defer(
            "occ_gui.export.export_controller:ExportController",
            window, shell, present, preferences, current_pane, store,
        ),
        commands={
            "export_all": lambda export: export.ask_for_folder(),
            "copy_figure": lambda export: export.copy_current(),
        },
    )  # fmt: skip


def animation(
    window: QWidget, scenes: SceneStore, preferences: Preferences, bar: WorkBar
) -> Feature[Any]:
    path = "occ_gui.export.animation:AnimationExport"
    return Feature(name="animation", make=defer(path, window, scenes, preferences, bar))


def transmitter(window: QWidget, scenes: SceneStore, preferences: Preferences) -> Feature[Any]:
    path = "occ_gui.transmitter.transmitter_controller:TransmitterController"
    return Feature(
        name="transmitter",
        make=defer(path, window, scenes, preferences),
        commands={"transmitter": lambda controller: controller.show()},
    )


def camera(window: QWidget, scenes: SceneStore, preferences: Preferences) -> Feature[Any]:
    return Feature(
        name="camera",
        make=defer(
            "occ_gui.camera.camera_controller:CameraController", window, scenes, preferences
        ),
        commands={"measure_camera": lambda controller: controller.show()},
    )


def manual(window: QMainWindow, shell: Shell, current_pane: Callable[[], str]) -> Feature[Any]:
    return Feature(
        name="help",
        make=lambda: defer("occ_gui.help.help_window:Manual")(
            window, current_pane, {"controls": "guide.md#set-up-a-scene", **shell.help_pages}
        ),
        commands={
            "guide": lambda manual: manual.show_page(),
            "about_pane": lambda manual: manual.show_pane(),
        },
    )


def welcome(
    window: MainWindow, shell: Shell, preferences: Preferences, files: FileController
) -> Feature[Any]:
    return Feature(
        name="welcome",
        make=defer("occ_gui.welcome.welcome:Welcome", window, shell, preferences, files),
        commands={"welcome": lambda page: page.show(), "my_lamp": lambda page: page.enter("bars")},
    )
