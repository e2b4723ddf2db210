"""Simulate a colour camera's picture: three lights, mixed, seen by a mosaic of three colours.

Each channel sees the sum of the lights, by the mixing matrix. The pixels at each of the four places
of the Bayer pattern are exposed as a monochrome camera of their own, so that a lens blurs the light
and not the mosaic. Then the mosaic is demosaiced and stored, as a whole.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.mosaic import demosaic, store_as_jpeg
from occ_model.camera.projection import check_size
from occ_model.effects.effect import PaperView, paper_view_of
from occ_model.effects.plan import plan_of_any
from occ_model.effects.registry import NAMES
from occ_model.effects.sensor_effects import Jpeg
from occ_model.results.colour import ColourFrame
from occ_model.results.decoding import Region
from occ_model.results.frame import Plan
from occ_model.scene.colour_scenes import EFFECTS_OFF, check_colour, led_scene
from occ_model.scene.scene import TOLERANCE, Observable, Scene, SimulationSettings
from occ_model.simulation.colour_channels import channel_views, filter_view
from occ_model.simulation.colour_effects import plan_with_colour
from occ_model.simulation.columns import Columns, expose_columns
from occ_model.simulation.render import render_plan
from occ_model.simulation.stage_timer import StageTimer


def render_colour(
    scene: Scene,
    *,
    tolerance: float = TOLERANCE.default,
    seed: int = 1,
    observable: Observable = "image",
    force: Mapping[str, bool] | None = None,
) -> ColourFrame:
    """Simulate the picture that a colour camera takes.

    Parameters
    ----------
    scene
        One with a Bayer pattern, that averages light.
    tolerance, seed, observable, force
        As for :func:`occ_model.render`; the tolerance holds for each LED's monochrome picture. The
        effects of colour take less time than their estimates, and so are simulated unless ``force``
        leaves one out: ``"mixing"``, ``"white-balance"``, ``"demosaicing"``, ``"jpeg"`` or
        ``"chroma"``.

    Raises
    ------
    ParameterError
        As for :func:`occ_model.render`, or the scene is not one of a colour camera.
    ProjectionError
        As for :func:`occ_model.render`.
    """
    settings = SimulationSettings(tolerance, observable, force or {}, seed=seed)
    return render_colour_with(scene, settings)


def plan_colours(scene: Scene, settings: SimulationSettings) -> Plan:
    """Decide which effects of a colour camera's picture are simulated."""
    return _prepare(scene, settings, StageTimer()).plan


def render_colour_with(scene: Scene, settings: SimulationSettings) -> ColourFrame:
    """Simulate a colour camera's picture with some settings, as :func:`render_colour` does."""
    timer = StageTimer()
    prepared = _prepare(scene, settings, timer)
    image = _process(_expose_mosaic(scene, prepared, settings.seed, timer), prepared, timer)
    region = prepared.views[0].region
    return ColourFrame(
        scene=scene,
        plan=prepared.plan,
        image=image,
        profiles=channel_means(image, scene, region),
        region=region,
        timings=timer.timings,
    )


@dataclass(frozen=True, eq=False, slots=True)
class _Prepared:
    scene: Scene  # Without the effects that are switched off
    plan: Plan
    views: list[PaperView]  # What each channel sees
    columns: list[Columns]  # The same, exposed


def _prepare(scene: Scene, settings: SimulationSettings, timer: StageTimer) -> _Prepared:
    check_colour(scene)
    check_size(scene.camera)
    settings = settings.check((*NAMES, *EFFECTS_OFF))
    leds = [paper_view_of(led_scene(scene, index)) for index in range(3)]
    timer.end_stage("exposure")
    different = list({view.scene: view for view in leds}.values())
    force = {name: on for name, on in settings.force.items() if name in NAMES}
    plan = plan_of_any(different, replace(settings, force=force))
    timer.end_stage("plan")
    views = channel_views(scene, leds, plan)
    columns = [expose_columns(view, sensor_plan(plan)) for view in views]
    timer.end_stage("exposure")
    profiles = [each.profile for each in columns]
    plan = plan_with_colour(scene, plan, leds, profiles, settings.force)
    timer.end_stage("plan")
    shown = scene
    for effect, is_on in settings.force.items():
        shown = shown if is_on else shown.replace(**EFFECTS_OFF.get(effect, {}))
    if shown != scene:
        views = channel_views(shown, leds, plan)
        columns = [expose_columns(view, sensor_plan(plan)) for view in views]
        timer.end_stage("exposure")
    return _Prepared(shown, plan, views, columns)


def sensor_plan(plan: Plan) -> Plan:
    """Return the part of a plan that is left for each channel: not its light, nor the file."""
    apart = ("light", "processing")
    return replace(plan, decisions=tuple(d for d in plan.decisions if d.stage not in apart))


def _expose_mosaic(scene: Scene, prepared: _Prepared, seed: int, timer: StageTimer) -> ByteArray:
    """Expose the pixels at each place of the pattern, as a monochrome camera of their own."""
    rows, columns = scene.camera.rows, scene.camera.columns
    mosaic = np.empty((rows, columns), dtype=np.uint8)
    plan = sensor_plan(prepared.plan)
    for place, (channel, own) in enumerate(scene.colours.filters):
        if mosaic[own].size:
            view = filter_view(prepared.views[channel], place)
            mosaic[own] = render_plan(view, plan, seed=4 * seed + place, timer=timer).camera_image
            timer.end_stage("mosaic")
    return mosaic


def _process(mosaic: ByteArray, prepared: _Prepared, timer: StageTimer) -> ByteArray:
    """Demosaic and store a raw picture, as the scene's camera does."""
    scene, plan = prepared.scene, prepared.plan
    if "demosaicing" not in plan:
        return mosaic
    image = demosaic(mosaic, scene)
    timer.end_stage("demosaicing")
    if Jpeg.name in plan:
        image = store_as_jpeg(image, scene.camera.jpeg_quality, scene.colours.chroma)
        timer.end_stage(Jpeg.name)
    return image


def channel_means(image: ByteArray, scene: Scene, region: Region) -> FloatArray:
    """Return the mean of each channel in each column of the picture, over the panel's rows."""
    rows = slice(region.first_row, max(region.last_row, region.first_row + 2))
    if image.ndim == 3:
        seen = image[rows]
        sums = cv2.reduce(seen.reshape(len(seen), -1), 0, cv2.REDUCE_SUM, dtype=cv2.CV_64F)
        return np.asarray(sums.reshape(-1, 3).T / len(seen), dtype=np.float64)
    means = np.full((3, image.shape[1]), math.nan)
    for channel, (lines, columns) in scene.colours.filters:
        own = image[rows.start + (lines.start - rows.start) % 2 : rows.stop : 2, columns]
        if own.size:
            means[channel, columns] = own.mean(axis=0)
    return means
