"""Render a room: one picture of all lamps that its camera sees."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.coverage import Coverage
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.optics import Optics
from occ_model.camera.picture_rows import LitPanel, PictureRows, split_at, split_into_blocks
from occ_model.camera.projection import check_size
from occ_model.effects.effect import OpticsEffect, PaperView, paper_view_of, region_of
from occ_model.effects.plan import plan_of_any
from occ_model.effects.registry import NAMES, effects_named
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.results.decoding import Region
from occ_model.results.frame import Plan
from occ_model.room.room import Room, RoomLamp
from occ_model.room.view import LampView, lamps_in_view
from occ_model.scene.scene import (
    TOLERANCE,
    Observable,
    Pose,
    Scene,
    SimulationSettings,
    Transmitter,
)
from occ_model.simulation.columns import Columns, expose_columns
from occ_model.simulation.pixel_draw import PictureNumbers
from occ_model.simulation.pixels import PixelExposure
from occ_model.simulation.render import render_plan
from occ_model.simulation.stage_timer import StageTimer


@dataclass(frozen=True, eq=False, slots=True)
class PicturedLamp:
    lamp: RoomLamp
    # Shape (corners, 2): its outline in the picture, with (column, row) of each corner
    outline: FloatArray
    region: Region  # Its bounding rectangle in the picture
    is_cut: bool  # Whether a part of it is outside the picture
    profile: FloatArray  # Shape (columns,): its pixel value in each column, without other lamps
    enhancement: Enhancement  # of its pixels by the receiver
    blur: float  # Standard deviation of the lens's blur, in pixels


@dataclass(frozen=True, eq=False)
class RoomFrame:
    """One simulated picture of a room.

    Parameters
    ----------
    plan
        The simulated effects: those that the picture of at least one lamp needs.
    camera_image : ndarray of uint8, shape (rows, columns)
        The camera's picture.
    lamps
        The lamps in the picture, in the room's order.
    timings
        Seconds of each stage.
    """

    room: Room
    plan: Plan
    camera_image: ByteArray
    lamps: tuple[PicturedLamp, ...]
    timings: Mapping[str, float]

    @cached_property
    def image(self) -> ByteArray:
        """The receiver's picture: each lamp is enhanced separately, by the scene's method."""
        image = self.camera_image.copy()
        rows, columns = image.shape
        for lamp in self.lamps:
            for band in split_into_blocks(range(rows), columns):
                is_covered = Coverage(lamp.outline, rows, columns, lamp.blur).rows(band) >= 0.5
                camera = self.camera_image[band.start : band.stop]
                enhanced = image[band.start : band.stop]
                np.copyto(enhanced, lamp.enhancement.enhance_bytes(camera), where=is_covered)
        return image


def render_room(
    room: Room,
    *,
    tolerance: float = TOLERANCE.default,
    seed: int = 1,
    observable: Observable = "image",
    force: Mapping[str, bool] | None = None,
    noise: object = None,  # noqa: ARG001 - of former versions
) -> RoomFrame:
    """Simulate the picture that a room's camera takes.

    A lamp outside the picture takes no time. Noise, the sensor and the file are simulated once, for
    the sum of all light.

    Parameters
    ----------
    tolerance, seed, observable, force, noise
        As for :func:`occ_model.render`; the tolerance holds for each lamp.

    Raises
    ------
    ParameterError
        As for :func:`occ_model.render`.
    ProjectionError
        A lamp in the picture reaches behind the camera, or the picture would be too large.
    """
    settings = SimulationSettings(tolerance, observable, force or {}, seed=seed).check(NAMES)
    check_size(room.scene.camera)
    timer = StageTimer()
    lamp_views = lamps_in_view(room)
    timer.end_stage("projection")
    views = [lamp_view.view for lamp_view in lamp_views] or [_dark_view(room.scene)]
    effect_plan = plan_of_any(_select_extreme(views), settings)
    timer.end_stage("plan")
    if len(views) == 1:
        frame = render_plan(views[0], effect_plan, seed=seed, timer=timer)
        columns, image = [expose_columns(views[0], effect_plan)], frame.camera_image
    else:
        columns, image = _compose(views, effect_plan, settings, timer)
    pictured = tuple(
        _make_pictured_lamp(lamp_view, effect_plan, lamp_columns)
        for lamp_view, lamp_columns in zip(lamp_views, columns, strict=False)
    )
    lamps = tuple(lamp for lamp in pictured if lamp is not None)
    return RoomFrame(room, effect_plan, image, lamps, timer.timings)


def _dark_view(scene: Scene) -> PaperView:
    return paper_view_of(dataclasses.replace(scene, pose=Pose(distance=1.0, offset_x=1e3)))


def _select_extreme(views: Sequence[PaperView]) -> list[PaperView]:
    """Return the lamps for which an effect can be largest.

    They are extreme in depth (defocus), place in the picture (vignetting, distortion), tilt and
    order (emission), light (noise), number of pixels, speed of the light's changes, edge time, or
    swing (which an enhancement stretches).
    """

    def features(view: PaperView) -> tuple[float, ...]:
        scene, corners = view.scene, view.corners
        camera, transmitter = scene.camera, scene.transmitter
        middle = np.array([camera.columns - 1, camera.rows - 1]) / 2.0
        return (
            scene.pose.distance, float(np.hypot(*(corners - middle).T).max()),
            float(np.ptp(corners[:, 0]) * np.ptp(corners[:, 1])) / transmitter.panel_width
            / transmitter.panel_height, transmitter.luminance, _fastest_change(transmitter),
            view.swing, transmitter.edge_time, transmitter.lambertian_order,
            float(np.ptp(corners[:, 0])),
        )  # fmt: skip

    table = np.array([features(view) for view in views])
    # Differences by rounding alone must not add a lamp.
    table = np.round(table / np.maximum(np.abs(table).max(axis=0), 1e-30), 6)
    indices = {*table.argmin(axis=0).tolist(), *table.argmax(axis=0).tolist()}
    return [views[place] for place in sorted(indices)]


def _fastest_change(transmitter: Transmitter) -> float:
    """Return the frequency of a light's fastest changes, in Hz."""
    light = light_of(transmitter)
    if isinstance(light, Cosine):
        return light.frequency
    return float(light.rate / min(light.waveform.lengths.tolist()))


def _optics_of(view: PaperView, effect_plan: Plan) -> Optics:
    optics = Optics(view.corners)
    for effect in effects_named(effect_plan.included, OpticsEffect):
        optics = effect.apply(view.scene, optics)
    return optics


def _compose(
    views: list[PaperView], effect_plan: Plan, settings: SimulationSettings, timer: StageTimer
) -> tuple[list[Columns], ByteArray]:
    """Return the columns of each lamp, and the camera's picture of all lamps."""
    camera = views[0].scene.camera
    columns = [expose_columns(view, effect_plan, timer) for view in views]
    panels = [
        LitPanel(_optics_of(view, effect_plan), lamp_columns.panel)
        for view, lamp_columns in zip(views, columns, strict=True)
    ]
    timer.end_stage("optics")
    bands = split_into_blocks(range(camera.rows), camera.columns)
    if all(panel.optics.is_plain for panel in panels) and camera.jpeg_quality == 0:
        level = [view.region for view in views if view.sides]
        ends = [
            end for lamp_columns in level for end in (lamp_columns.first_row, lamp_columns.last_row)
        ]
        bands = [part for band in bands for part in split_at(band, ends)]
    mean = PictureRows(camera, panels, columns[0].surroundings)
    exposure = PixelExposure(views[0], effect_plan, columns[0], timer, bands, mean=mean)
    plain = Enhancement(columns[0].profile, "none")
    pictures = exposure.pictures(plain, PictureNumbers(settings.seed, camera.columns))
    return columns, pictures.camera_image


def _make_pictured_lamp(
    lamp_view: LampView, effect_plan: Plan, columns: Columns
) -> PicturedLamp | None:
    camera, optics = lamp_view.view.scene.camera, _optics_of(lamp_view.view, effect_plan)
    outline = optics.outline
    region = region_of(outline, camera.rows, camera.columns)
    if region is None:
        return None
    column, row = outline.T
    is_cut = bool(
        column.min() < 0 or row.min() < 0
        or column.max() > camera.columns - 1 or row.max() > camera.rows - 1
    )  # fmt: skip
    profile, enhancement = columns.profile, columns.enhancement
    return PicturedLamp(lamp_view.lamp, outline, region, is_cut, profile, enhancement, optics.blur)
