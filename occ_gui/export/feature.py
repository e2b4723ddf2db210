"""The exports of figures and of animations, declared."""

from collections.abc import Callable

from PySide6.QtWidgets import QWidget

from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Service
from occ_gui.shell.shell import Shell
from occ_gui.simulation.present_results import PresentResults
from occ_gui.widgets.work_bar import WorkBar


def export(
    window: QWidget,
    shell: Shell,
    present: PresentResults,
    preferences: Preferences,
    current_pane: Callable[[], str],
    scenes: SceneStore,
) -> Feature[None]:
    def make() -> Service:
        from occ_gui.export.export_controller import ExportController

        def decoder() -> str:
            return scenes.store.workspace.decoder

        return ExportController(window, shell, present, preferences, current_pane, decoder)

    return Feature(
        name="export",
        make=make,
        commands={
            "export_all": lambda export: export.ask_for_folder(),
            "copy_figure": lambda export: export.copy_current(),
        },
    )


def animation(
    window: QWidget, scenes: SceneStore, preferences: Preferences, bar: WorkBar
) -> Feature[None]:
    """Declare the export of a slider's run, with a bar that shows how far it is."""

    def make() -> Service:
        from occ_gui.export.animation import AnimationExport

        return AnimationExport(window, scenes, preferences, bar)

    return Feature(name="animation", make=make)
