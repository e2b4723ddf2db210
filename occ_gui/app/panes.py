"""Declarations of the window's panes; heavy modules are imported when needed."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from occ_gui.app.figures import (
    accuracy_figure,
    bands_figures,
    bench_figure,
    decoding_figures,
    map_figure,
    picture_figures,
    profile_figure,
    room_figure,
)
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.detection_map.wiring import BackgroundRates
from occ_gui.files.preferences import Preferences
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.window_actions import WindowActions
from occ_gui.pins.pin_controller import PinController
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane, defer
from occ_gui.shell.results import Results, ResultsStore
from occ_gui.simulation.controller import SimulationController
from occ_gui.values.modes import PanePlace

if TYPE_CHECKING:
    from occ_gui.photo.pane import PhotoPane
    from occ_gui.picture.image_view import ImageView
    from occ_gui.widgets.plot import Plot


def picture(store: Store, describe_photo: Callable[[], str]) -> Feature[Any]:
    """Declare the pane that replaces the story's rows; ``describe_photo`` returns the caption."""

    def part(workspace: Workspace, results: Results) -> tuple[object, ...]:
        pictures = (results.before, results.picture, results.snapshot, results.reading)
        return (workspace.picture_kind, workspace.overlay, *pictures)

    return Feature(
        name="picture",
        title="Picture",
        help="guide.md#look-at-the-picture",
        make=defer("occ_gui.picture.image_view:PicturesPane", store),
        part=part,
        updates_hidden=True,
        figures=picture_figures(store, describe_photo),
    )


def decoding(store: Store) -> Feature[Any]:
    return Feature(
        name="decode",
        title="Decoding",
        is_about_codes=True,
        default_side="right",
        help="decoding.md",
        make=defer("occ_gui.decoding.pane:DecodePane", store),
        part=lambda workspace, results: (results.reading, workspace.decoder),
        updates_hidden=True,
        figures=decoding_figures(),
    )


_PHOTO_ACTIONS = (
    "close_photo", "match", "use_settings", "find_lamps", "region_by_hand", "whole_photo",
    "export_overlay",
)  # fmt: skip
_MATCH_ACTIONS = ("apply_match", "save_match")


def photo(
    scenes: SceneStore,
    photos: PhotoController,
    image: "Callable[[], ImageView]",
    results_store: ResultsStore,
    window: WindowActions,
) -> Feature[Any]:
    """Declare the pane; ``image`` returns the view of the picture, where the photo is shown."""

    def make() -> "PhotoPane":
        from occ_gui.photo.pane import PhotoPane

        return PhotoPane(scenes, photos, image(), results_store, window)

    def enabled(workspace: Workspace, results: Results) -> dict[str, bool]:
        has_photo = has_match = results.document is not None
        if has_photo:
            from occ_gui.photo.shown_photo import find_match

            outcome = find_match(results)
            has_match = outcome is not None and outcome.match is not None
        return {
            **dict.fromkeys(_PHOTO_ACTIONS, has_photo),
            **dict.fromkeys(_MATCH_ACTIONS, has_match),
            "match_all": bool(workspace.photo.listed),
        }

    return Feature(
        name="photo",
        title="Photo",
        places={"photo": PanePlace("left", is_main=True, width=360)},
        default_side="right",
        help="photos.md",
        make=make,
        part=defer("occ_gui.photo.shown_photo:ShownPhoto.of"),
        updates_hidden=True,
        enabled=enabled,
        commands={
            "match_all": lambda pane: pane.match_all(),
            "find_lamps": lambda pane: pane.lamps.find(),
            "region_by_hand": lambda pane: pane.view.lamps.by_hand.toggle(),
            "whole_photo": lambda pane: pane.parts.match_whole(),
            "apply_match": lambda pane: pane.matching.apply(),
            "save_match": lambda pane: window.save_match(pane.matching),
            "use_settings": lambda pane: pane.matching.apply_camera_settings(),
        },
    )


def photos(pane: "Callable[[], PhotoPane]") -> Feature[Any]:
    return Feature(
        name="photos",
        title="Photos",
        places={"photo": PanePlace("bottom")},
        help="photos.md#many-photos-one-answer",
        make=lambda: Pane[None](pane().view.many),
    )


def profile(
    store: Store, results_store: ResultsStore, describe_photo: Callable[[], str]
) -> Feature[Any]:
    """Declare the pane; ``describe_photo`` returns the caption of a figure with the photo."""

    def part(workspace: Workspace, results: Results) -> tuple[object, ...]:
        photo = (results.photo_profile, results.code_chips)
        return workspace.is_enhanced, results.before, results.reading, *photo

    return Feature(
        name="profile",
        title="Column profile",
        places={"photo": PanePlace("bottom", height=210)},
        help="guide.md#compare-column-profiles",
        make=defer("occ_gui.profile.pane:ProfilePane", store),
        part=part,
        updates_hidden=True,
        figures=(profile_figure(store, results_store, describe_photo),),
    )


def accuracy(scenes: SceneStore, simulation: SimulationController) -> Feature[Any]:
    """Declare the pane; it measures while it is visible, but never during a simulation."""
    return Feature(
        name="accuracy",
        title="Accuracy and time",
        places={"effects": PanePlace("right", is_main=True)},
        help="model.md#accuracy-against-time",
        make=defer("occ_gui.accuracy.pane:AccuracyPane", scenes, simulation),
        part=lambda workspace, results: (
            workspace.settings,
            workspace.has_code,
            results.switched,
            results.snapshot,
        ),
        figures=(accuracy_figure(),),
    )


def detection_map(scenes: SceneStore, background_rates: BackgroundRates) -> Feature[Any]:
    return Feature(
        name="map",
        title="Detection map",
        is_about_codes=True,
        places={"limits": PanePlace("right", is_main=True)},
        help="limits.md#the-detection-map",
        make=defer("occ_gui.detection_map.pane:MapPane", scenes, background_rates),
        figures=(map_figure(scenes.store),),
    )


def bands(scenes: SceneStore) -> Feature[Any]:
    return Feature(
        name="bands",
        title="Bars",
        places={"limits": PanePlace("right")},
        help="limits.md#no-bars-no-flicker",
        make=defer("occ_gui.bands.pane:BandsPane", scenes),
        part=lambda workspace, _: workspace.scene,
        figures=bands_figures(),
    )


def equations(scenes: SceneStore, plot: "Callable[[], Plot]") -> Feature[Any]:
    """Declare the pane; the user picks its column in the plot of the profile."""
    return Feature(
        name="equations",
        title="Equations",
        default_side="right",
        help="model.md",
        make=lambda: defer("occ_gui.explanation.pane:ExplanationPane")(scenes, plot()),
        part=lambda _, results: results.snapshot,
    )


def spectrum() -> Feature[Any]:
    pane, view = "occ_gui.spectrum.pane:SpectrumPane", "occ_gui.spectrum.spectrum_view:SpectrumView"
    return Feature(
        name="spectrum",
        title="Spectrum and levels",
        help="guide.md#measure",
        make=lambda: defer(pane)(defer(view)()),
        part=lambda _, results: results.snapshot,
    )


def colour() -> Feature[Any]:
    return Feature(
        name="colour",
        title="Three colours",
        help="model.md#a-colour-camera",
        make=defer("occ_gui.colour.pane:ColourPane"),
        part=lambda workspace, _: (workspace.scene, workspace.settings, workspace.decoder),
    )


def compare(pins: PinController) -> Feature[Any]:
    return Feature(
        name="compare",
        title="Compare",
        help="guide.md#compare-two-states",
        make=defer("occ_gui.pins.compare_view:ComparePane", pins),
        actions={
            "pin_a": lambda: pins.pin("A"),
            "pin_b": lambda: pins.pin("B"),
            "go_to_a": lambda: pins.go_to("A"),
            "go_to_b": lambda: pins.go_to("B"),
            "clear_pins": pins.clear,
        },
    )


def lessons(
    scenes: SceneStore,
    results_store: ResultsStore,
    controls: ControlPanel,
    preferences: Preferences,
) -> Feature[Any]:
    return Feature(
        name="lessons",
        title="Lessons",
        places={"lessons": PanePlace("right", is_main=True, width=340)},
        default_side="right",
        help="guide.md#follow-a-lesson",
        make=defer("occ_gui.lessons.pane:LessonPane", scenes, results_store, controls, preferences),
    )


def video(scenes: SceneStore, results_store: ResultsStore) -> Feature[Any]:
    return Feature(
        name="video",
        title="Video",
        places={"video": PanePlace("right", is_main=True)},
        default_side="right",
        help="films.md#watch-a-film",
        make=defer("occ_gui.video.wiring:VideoWiring", scenes, results_store),
        enabled=lambda workspace, _: {"close_film": workspace.film.path is not None},
        part=lambda workspace, _: workspace.film,
    )


def room(store: Store) -> Feature[Any]:
    return Feature(
        name="room",
        title="Room",
        places={"room": PanePlace("right", is_main=True)},
        help="rooms.md",
        make=defer("occ_gui.room.pane:RoomPane", store),
        part=lambda workspace, _: workspace.room,
        updates_hidden=True,  # its figure can be exported, and its steps undone, while it is hidden
        figures=(room_figure(),),
    )


def bench(scenes: SceneStore, background_rates: BackgroundRates) -> Feature[Any]:
    return Feature(
        name="bench",
        title="Bench",
        is_about_codes=True,
        places={"limits": PanePlace("right")},
        help="limits.md#the-bench",
        make=lambda: defer("occ_gui.bench.pane:BenchPane")(
            scenes, background_rates.channel("bench")
        ),
        figures=(bench_figure(scenes.store),),
    )
