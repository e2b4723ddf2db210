"""From a scene to a frame: the stages in the order light travels, each one timed."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.photometry import (
    ColumnLight,
    panel_values,
    saturate,
    surroundings_values,
)
from occ_model.camera.projection import check_size, paint, panel_corners
from occ_model.checks import check_choice, check_seed
from occ_model.effects.effect import LightEffect, PixelEffect
from occ_model.effects.plan import plan
from occ_model.effects.registry import planned
from occ_model.pixels import PixelExposure
from occ_model.results import Frame, Plan
from occ_model.scene import Scene
from occ_model.simulation_settings import NOISE_SOURCES, TOLERANCE, NoiseSource, Observable
from occ_model.stage_clock import StageClock


@dataclass(frozen=True, eq=False, slots=True)
class Columns:
    """What each column shows, as far as all rows are alike.

    Parameters
    ----------
    panel, surroundings : ndarray of float64, shape (columns,)
        Pixel values of the panel and beside it, before saturation.
    """

    panel: FloatArray
    surroundings: FloatArray

    @property
    def profile(self) -> FloatArray:
        """The column values, PV_sim, in grey levels."""
        return saturate(self.panel)


def expose_columns(scene: Scene, chosen: Plan, clock: StageClock | None = None) -> Columns:
    """Simulate all that leaves the rows alike: the light, the exposure, the pixel's limits.

    Parameters
    ----------
    scene
        The scene.
    chosen
        Its column effects are simulated.
    clock
        Is told of each stage.
    """
    clock = clock or StageClock()
    light = ColumnLight.of(scene)
    clock.done("exposure")
    for effect in planned(chosen, LightEffect):
        light = effect.apply(scene, light)
        clock.done(effect.name)
    panel = panel_values(scene, light)
    around = np.broadcast_to(surroundings_values(scene, light), panel.shape)
    clock.done("exposure")
    for limit in planned(chosen, PixelEffect):
        panel = limit.apply(scene, panel)
        around = limit.apply(scene, around)
        clock.done(limit.name)
    return Columns(panel, around)


def render(
    scene: Scene,
    *,
    tolerance: float = TOLERANCE.default,
    seed: int = 1,
    observable: Observable = "image",
    force: Mapping[str, bool] | None = None,
    noise: NoiseSource = "exact",
) -> Frame:
    """Simulate the picture that the scene's camera takes.

    Parameters
    ----------
    scene
        The scene.
    tolerance
        How much, in levels of the stretched profile, effects left out may change; 0: every effect
        that is not exactly nothing is simulated; infinity: none, the bare paper model.
    seed
        Of all that is random.
    observable, force
        What the tolerance is of, and effects switched on or off by hand: as for
        :func:`occ_model.plan`.
    noise
        ``"exact"``: drawn for every pixel; ``"reused"``: from a plane of noise at random places,
        many times faster.

    Returns
    -------
    Frame

    Raises
    ------
    ParameterError
        The tolerance or the seed is negative, or no number; there is no such observable, effect or
        source of noise; or the picture is too large for the JPEG file that the scene asks for.
    ProjectionError
        Part of the panel is behind the camera, the lens folds the picture, or the image would be
        too large.
    """
    check_seed(seed)
    check_choice("noise", noise, NOISE_SOURCES)
    clock = StageClock()
    # The corners first: they cost nothing, and a pose without a picture is refused at once.
    corners = panel_corners(scene)
    check_size(scene.camera)
    clock.done("projection")
    chosen = plan(scene, tolerance, observable, force)
    clock.done("plan")
    columns = expose_columns(scene, chosen, clock)
    enhancement = Enhancement(columns.profile, scene.model.enhancement)
    enhanced = enhancement(columns.profile)
    clock.done("enhancement")
    if chosen.kinds <= {"column"}:
        profile = columns.profile
        image = paint(enhanced, corners, scene.camera.rows, _dark(columns))
        clock.done("image")
    else:
        exposure = PixelExposure(scene, chosen, columns.panel, columns.surroundings, clock)
        image, profile = exposure.picture(enhancement, seed, noise)
    return Frame(scene, chosen, image, profile, enhanced, corners, clock.timings)


def observe(scene: Scene, chosen: Plan, *, seed: int = 1, noise: NoiseSource = "exact") -> Pixels:
    """Give what a plan's tolerance is of: pixel values before enhancement and rounding.

    Parameters
    ----------
    scene
        The scene.
    chosen
        Its effects are simulated, and its observable is given.
    seed, noise
        As for :func:`render`.

    Returns
    -------
    ndarray of float32
        ``"image"``: the pixels of the panel's bounding rectangle, shape (rows, columns) of it;
        ``"profile"``: the means of its columns.
    """
    clock = StageClock()
    columns = expose_columns(scene, chosen, clock)
    exposure = PixelExposure(scene, chosen, columns.panel, columns.surroundings, clock)
    return exposure.observed(chosen.observable, seed, noise)


def _dark(columns: Columns) -> ByteArray:
    """Give the surroundings' grey levels, shape (columns,)."""
    return to_bytes(saturate(columns.surroundings))
