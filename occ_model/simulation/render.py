"""Render a scene: simulate its picture stage by stage, in the order that light travels."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.photometry import WHITE, saturation_value
from occ_model.camera.picture_rows import split_into_blocks
from occ_model.camera.projection import check_size, paint
from occ_model.effects.effect import PaperView, paper_view_of
from occ_model.effects.plan import plan_of
from occ_model.effects.registry import NAMES
from occ_model.parallel.job import Heartbeat
from occ_model.results.frame import Frame, Plan
from occ_model.scene.argument_checks import check_count
from occ_model.scene.scene import (
    TOLERANCE,
    Observable,
    Scene,
    SimulationSettings,
)
from occ_model.simulation.columns import expose_columns
from occ_model.simulation.pictures import PaintedColumns, Pictures
from occ_model.simulation.pixel_draw import PictureNumbers
from occ_model.simulation.pixels import PixelExposure
from occ_model.simulation.stage_timer import StageTimer

_ROUNDING = 1.0  # grey levels by which the mean of a column of full pixels may be too small


def overexposed_fraction(
    scene: Scene, plan: Plan, profile: FloatArray, corners: FloatArray
) -> float:
    """Return the fraction of the panel's columns whose pixels are all white, or full.

    Parameters
    ----------
    plan : Plan
        The effects that the profile is simulated with.
    profile : ndarray of float64, shape (columns,)
        Means of the panel's pixels in each column before enhancement, in grey levels.
    corners : ndarray of float64, shape (4, 2)
        The panel's corners, each as (column, row).
    """
    left, right = float(corners[:, 0].min()), float(corners[:, 0].max())
    seen = profile[max(0, round(left)) : max(0, round(right) + 1)]
    limit = saturation_value(scene) if "full-well" in plan else WHITE
    return float(np.mean(seen >= limit - _ROUNDING)) if seen.size else 0.0


def render(
    scene: Scene,
    *,
    tolerance: float = TOLERANCE.default,
    seed: int = 1,
    observable: Observable = "image",
    force: Mapping[str, bool] | None = None,
    noise: object = None,  # noqa: ARG001 - of former versions
    rows_step: int = 1,
) -> Frame:
    """Simulate the picture that the scene's camera takes.

    Parameters
    ----------
    tolerance
        Largest change by the omitted effects, in levels of the stretched profile. 0 simulates every
        effect of the scene; infinity simulates none, which is the paper's model.
    seed
        Seed of all random numbers.
    observable, force
        The quantity to which the tolerance refers, and effects that are switched on or off; see
        :func:`occ_model.plan`.
    noise
        Ignored: noise is always drawn for every pixel.
    rows_step
        From 2 on, the frame is a draft: it has only every ``rows_step``-th row of the picture,
        equal to that row. A file is made of the draft's rows as if they were a picture, and only
        where they show the panel.

    Raises
    ------
    ParameterError
        The tolerance or the seed is negative or not a number; there is no such observable or
        effect; ``rows_step`` is less than 1 or more than the picture's rows; or the picture is too
        large for a JPEG file, which the scene has.
    ProjectionError
        Part of the panel is behind the camera, the lens folds the picture, or the image would be
        too large.
    """
    force = {} if force is None else force
    settings = SimulationSettings(tolerance, observable, force, seed=seed)
    return render_with(scene, settings, rows_step)


@dataclass(frozen=True, eq=False, slots=True)
class PlannedScene:
    """A scene with its planned effects, from which its draft and its whole picture start."""

    view: PaperView  # The paper's view of the scene
    plan: Plan
    timings: Mapping[str, float]  # Seconds of each stage so far


def plan_scene(scene: Scene, settings: SimulationSettings) -> PlannedScene:
    """Plan the effects of a scene; the seed in the settings does not matter."""
    settings = settings.check(NAMES)
    check_size(scene.camera)
    timer = StageTimer()
    view = paper_view_of(scene, timer.end_stage)
    chosen = plan_of(view, settings)
    timer.end_stage("plan")
    return PlannedScene(view, chosen, timer.timings)


def render_with(
    scene: Scene,
    settings: SimulationSettings,
    rows_step: int = 1,
    heartbeat: Heartbeat = lambda: None,
    planned: PlannedScene | None = None,
    show_panel: Callable[[Frame], object] | None = None,
) -> Frame:
    """Simulate the picture of a scene with some settings, as :func:`render` does.

    The heartbeat is called before each band of rows; ``planned`` saves a :func:`plan_scene`.
    ``show_panel`` is called with a frame of the rows that show the panel, if these are made first.
    """
    check_count("rows_step", rows_step, 1, scene.camera.rows)
    settings = settings.check(NAMES)
    if planned is None:
        planned = plan_scene(scene, settings)
    timer = StageTimer(planned.timings)
    return render_plan(
        planned.view,
        planned.plan,
        seed=settings.seed,
        rows_step=rows_step,
        timer=timer,
        heartbeat=heartbeat,
        show_panel=show_panel,
    )


def render_plan(
    view: PaperView,
    chosen: Plan,
    *,
    seed: int,
    rows_step: int = 1,
    timer: StageTimer | None = None,
    heartbeat: Heartbeat = lambda: None,
    show_panel: Callable[[Frame], object] | None = None,
) -> Frame:
    """Simulate a picture with planned effects."""
    scene = view.scene
    check_size(scene.camera)
    timer = timer or StageTimer()
    columns = expose_columns(view, chosen, timer)
    enhancement = columns.enhancement
    enhanced = enhancement(columns.profile)
    timer.end_stage("enhancement")
    around, corners = to_bytes(columns.around), view.corners
    rows = draft_rows(scene.camera.rows, rows_step)
    made: Pictures | PaintedColumns
    frame = partial(Frame, scene=scene, plan=chosen, corners=corners, timings=timer.timings)
    if chosen.kinds <= {"column"}:
        image = paint(enhanced, corners, rows, around)
        camera_image = partial(paint, to_bytes(columns.profile), corners, rows, around)
        made = PaintedColumns(image, columns.profile, enhanced.astype(np.float64), camera_image)
        timer.end_stage("image")
    else:
        bands = split_into_blocks(rows, scene.camera.columns)
        exposure = PixelExposure(view, chosen, columns, timer, bands, panel_only=rows_step > 1)
        numbers = PictureNumbers(seed, scene.camera.columns)

        def show(place: slice, part: Pictures) -> None:
            if show_panel is not None:
                show_panel(frame(rows=rows[place], pictures=part))

        made = exposure.pictures(enhancement, numbers, heartbeat, show_panel and show)
    return frame(rows=rows, pictures=made)


def draft_rows(rows: int, step: int) -> range:
    """Return every ``step``-th row of a picture, each near the middle of those it stands for."""
    return range(min(step // 2, (rows - 1) % step), rows, step)


def observe(
    scene: Scene,
    chosen: Plan,
    *,
    seed: int = 1,
    timer: StageTimer | None = None,
) -> Pixels:
    """Simulate the observable of a plan, in grey levels.

    ``"image"``: the camera's pixels of the panel's bounding rectangle, before rounding where no
    noise is drawn;
    ``"profile"``: the means of its columns; ``"signal"``: those of the receiver's picture.
    """
    check_size(scene.camera)
    view, timer = paper_view_of(scene), timer or StageTimer()
    if chosen.observable == "signal":
        image = render_plan(view, chosen, seed=seed, timer=timer).image
        return np.asarray(view.region.crop(image).mean(axis=0, dtype=np.float64), dtype=np.float32)
    columns = expose_columns(view, chosen, timer)
    seen = range(view.region.first_row, view.region.last_row)
    blocks = split_into_blocks(range(scene.camera.rows), scene.camera.columns)
    bands = [rows for rows in blocks if rows[0] < seen.stop and rows[-1] >= seen.start]
    exposure = PixelExposure(view, chosen, columns, timer, bands)
    return exposure.observe(chosen.observable, PictureNumbers(seed, scene.camera.columns))
