"""Declaration of the story in the middle of the window."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QWidget

from occ_gui.core.store import NO_GESTURE
from occ_gui.core.workspace import Workspace
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, PiecesPane
from occ_gui.shell.results import Results, of_picture, of_reading
from occ_gui.simulation.controller import SimulationController
from occ_gui.story.story_view import StoryView
from occ_model.receiver.decode import decoders
from occ_model.results.decoding import Remedy
from occ_model.scene.colour_scenes import is_colour

_REST_MS = 250  # milliseconds from the first picture to the search for plug-in decoders


class StoryPane(PiecesPane):
    def __init__(
        self,
        scenes: SceneStore,
        simulation: SimulationController,
        picture: QWidget,
        built_in: Sequence[str],
    ) -> None:
        self.view = view = StoryView(picture, built_in)
        super().__init__(
            view, view.choose_decoder, view.choose_picture, view.verdict.name_colour,
            view.show_reading, view.show_picture, view.rows.show_photo_profile,
        )  # fmt: skip
        # The stripes' picture follows the reading.
        self.made_of = {view.rows: of_reading, view.rows.stripes: of_picture}
        self.verdicts = (view.verdict,)
        self._scenes = scenes
        # The search for plug-ins takes some 40 ms, so it waits for the first picture.
        self._plugins = QTimer(self, singleShot=True)
        self._plugins.setInterval(_REST_MS)
        self._plugins.timeout.connect(self._offer_plugins)
        view.picture_kind.chosen.connect(self._choose_picture)
        view.decoder.chosen.connect(self.choose_decoder)
        view.verdict.step_chosen.connect(self._take_step)
        once = Qt.ConnectionType.SingleShotConnection
        simulation.snapshot_shown.connect(self._plugins.start, once)
        simulation.failed.connect(view.verdict.show_failure)
        simulation.submitted.connect(view.verdict.end_failure)

    def stop(self) -> None:
        self._plugins.stop()

    def _offer_plugins(self) -> None:
        self.view.offer_decoders(decoders())

    def choose_decoder(self, name: str) -> None:
        store = self._scenes.store
        store.put(replace(store.workspace, decoder=name))

    def _choose_picture(self, picture_kind: str) -> None:
        store, is_enhanced = self._scenes.store, picture_kind == "receiver"
        store.put(replace(store.workspace, picture_kind=picture_kind, is_enhanced=is_enhanced))

    def _take_step(self, step: Remedy) -> None:
        if step.decoder:
            self.choose_decoder(step.decoder)
        else:
            self._scenes.change(NO_GESTURE, **step.changes)


def declare_story(
    scenes: SceneStore, simulation: SimulationController, picture: QWidget, decoders: Sequence[str]
) -> Feature[Any]:
    """Declare the pane, which shows ``picture`` in place of its rows."""

    def part(workspace: Workspace, results: Results) -> tuple[object, ...]:
        # A photo's profile is drawn where both are enhanced, or neither is, and where the scene
        # comes from its match: any other photo shows something else.
        is_comparable = workspace.is_enhanced == (workspace.picture_kind == "receiver")
        match = results.match
        is_related = match is not None and match.is_origin_of(workspace.scene)
        photo = results.photo_profile if is_comparable and is_related else None
        scene = workspace.scene
        colour = scene.colours.shown_colour if is_colour(scene) else ""
        return (
            workspace.decoder, workspace.picture_kind, colour, results.reading, results.picture,
            photo,
        )  # fmt: skip

    return Feature(
        name="story",
        title="Story",
        make=lambda: StoryPane(scenes, simulation, picture, decoders),
        part=part,
        updates_hidden=True,
    )
