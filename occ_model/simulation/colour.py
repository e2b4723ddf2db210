"""Simulate a colour camera's picture: three lights, mixed, seen by a mosaic of three colours.

Each channel sees the sum of the lights, by the mixing matrix, and is exposed as a monochrome camera
of its own; its pixels are a quarter or half of the picture's. Then the mosaic is demosaiced and
stored, as a whole.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.mosaic import demosaic, store_as_jpeg
from occ_model.camera.picture_rows import split_into_blocks
from occ_model.camera.projection import check_size, paint
from occ_model.effects.effect import PaperView, paper_view_of
from occ_model.effects.plan import plan_of_any
from occ_model.effects.registry import NAMES
from occ_model.effects.sensor_effects import Jpeg
from occ_model.results.colour import ColourFrame
from occ_model.results.decoding import Region
from occ_model.results.frame import Plan
from occ_model.scene.colour_scenes import check_colour, led_scene
from occ_model.scene.scene import TOLERANCE, Observable, Scene, SimulationSettings
from occ_model.simulation.colour_channels import channel_views
from occ_model.simulation.colour_effects import colour_decisions
from occ_model.simulation.columns import Columns, expose_columns
from occ_model.simulation.pixel_draw import PictureNumbers
from occ_model.simulation.pixels import PixelExposure
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
        effects of colour take less time than their estimates, and so are always simulated.

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
    scene: Scene
    plan: Plan
    views: list[PaperView]  # What each channel sees
    columns: list[Columns]  # The same, exposed


def _prepare(scene: Scene, settings: SimulationSettings, timer: StageTimer) -> _Prepared:
    check_colour(scene)
    check_size(scene.camera)
    settings = settings.check(NAMES)
    leds = [paper_view_of(led_scene(scene, index)) for index in range(3)]
    timer.end_stage("exposure")
    different = list({view.scene: view for view in leds}.values())
    plan = plan_of_any(different, settings)
    timer.end_stage("plan")
    views = channel_views(scene, leds, plan)
    columns = [expose_columns(view, sensor_plan(plan)) for view in views]
    timer.end_stage("exposure")
    profiles = [each.profile for each in columns]
    stores = scene.camera.jpeg_quality > 0 and settings.force.get(Jpeg.name, True)
    decisions = colour_decisions(scene, plan, leds, profiles, stores=stores)
    timer.end_stage("plan")
    return _Prepared(scene, replace(plan, decisions=decisions), views, columns)


def sensor_plan(plan: Plan) -> Plan:
    """Return the part of a plan that is left for each channel: not its light, nor the file."""
    apart = ("light", "processing")
    return replace(plan, decisions=tuple(d for d in plan.decisions if d.stage not in apart))


def _expose_mosaic(scene: Scene, prepared: _Prepared, seed: int, timer: StageTimer) -> ByteArray:
    """Expose every second row with its two colours, then the others."""
    views, columns, plan = prepared.views, prepared.columns, sensor_plan(prepared.plan)
    size = scene.camera.rows, scene.camera.columns
    mosaic = np.empty(size, dtype=np.uint8)
    # A lens blurs each colour's light, not the mosaic, and a gain changes the law of the noise.
    is_apart = "defocus" in plan or len({view.scene.camera.iso for view in views}) > 1
    for row in range(min(2, size[0])):
        rows = range(row, size[0], 2)
        pair = ["rgb".index(letter) for letter in scene.colours.bayer[2 * row : 2 * row + 2]]
        if is_apart:
            for place, index in enumerate(pair[: size[1]]):
                own = _expose_rows(views[index], columns[index], plan, rows, seed, timer)
                mosaic[row::2, place::2] = own[:, place::2]
        else:
            first, second = pair
            both = _alternate(columns[first], columns[second])
            mosaic[row::2] = _expose_rows(views[first], both, plan, rows, seed, timer)
        timer.end_stage("mosaic")
    return mosaic


def _alternate(first: Columns, second: Columns) -> Columns:
    """Take every second column's values from the second, which is exposed under the same law."""
    is_first = np.arange(len(first.panel)) % 2 == 0
    names = ("panel", "surroundings", "profile", "around")
    values = {n: np.where(is_first, getattr(first, n), getattr(second, n)) for n in names}
    return replace(first, **values)


def _expose_rows(
    view: PaperView, columns: Columns, plan: Plan, rows: range, seed: int, timer: StageTimer
) -> ByteArray:
    count = view.scene.camera.columns
    if plan.kinds <= {"column"}:
        return paint(to_bytes(columns.profile), view.corners, rows, to_bytes(columns.around))
    exposure = PixelExposure(view, plan, columns, timer, split_into_blocks(rows, count))
    none = Enhancement(columns.profile, "none")
    return exposure.pictures(none, PictureNumbers(seed, count)).camera_image


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
    for place, letter in enumerate(scene.colours.bayer):
        first = rows.start + (place // 2 - rows.start) % 2
        own = image[first : rows.stop : 2, place % 2 :: 2]
        if own.size:
            means["rgb".index(letter), place % 2 :: 2] = own.mean(axis=0)
    return means
