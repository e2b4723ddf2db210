"""Simulate a colour camera's picture: three lights, mixed, seen by a mosaic of three colours.

Each channel sees the sum of the lights, by the mixing matrix, and is exposed as a monochrome camera
of its own; its pixels are a quarter or half of the picture's. Then the mosaic is demosaiced and
stored, as a whole.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

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


def render_colour_with(scene: Scene, settings: SimulationSettings) -> ColourFrame:
    """Simulate a colour camera's picture with some settings, as :func:`render_colour` does."""
    check_colour(scene)
    check_size(scene.camera)
    settings = settings.check(NAMES)
    timer = StageTimer()
    leds = [paper_view_of(led_scene(scene, index)) for index in range(3)]
    timer.end_stage("exposure")
    plan = plan_of_any(_different(leds), replace(settings, force=_without_file(settings.force)))
    timer.end_stage("plan")
    views = channel_views(scene, leds, plan)
    sensed = replace(plan, decisions=tuple(d for d in plan.decisions if d.stage != "light"))
    columns = [expose_columns(view, sensed) for view in views]
    timer.end_stage("exposure")
    mosaic = _expose_mosaic(scene, views, columns, sensed, settings.seed, timer)
    stores = scene.camera.jpeg_quality > 0 and settings.force.get(Jpeg.name, True)
    image = process(mosaic, scene, stores=stores, timer=timer)
    region = views[1].region
    decisions = colour_decisions(scene, plan, leds, [c.profile for c in columns], stores=stores)
    timer.end_stage("estimates of colour")
    return ColourFrame(
        scene=scene,
        plan=replace(plan, decisions=decisions),
        image=image,
        profiles=channel_means(image, scene, region),
        region=region,
        timings=timer.timings,
    )


def _without_file(force: Mapping[str, bool]) -> dict[str, bool]:
    """Keep the monochrome file effect out: a colour file is written after the demosaicing."""
    return {**force, Jpeg.name: False}


def _different(views: list[PaperView]) -> list[PaperView]:
    return list({view.scene: view for view in views}.values())


def _expose_mosaic(
    scene: Scene,
    views: list[PaperView],
    columns: list[Columns],
    plan: Plan,
    seed: int,
    timer: StageTimer,
) -> ByteArray:
    """Expose every second row with its two colours, then the others."""
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


def process(
    mosaic: ByteArray, scene: Scene, *, stores: bool, timer: StageTimer | None = None
) -> ByteArray:
    """Demosaic and store a raw picture, as the scene's camera does."""
    timer = timer or StageTimer()
    if scene.colours.demosaicing == "none":
        return mosaic
    image = demosaic(mosaic, scene)
    timer.end_stage("demosaicing")
    if stores:
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
