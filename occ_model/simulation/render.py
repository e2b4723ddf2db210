"""From a scene to a frame: the stages in the order light travels, each one timed."""

from collections.abc import Mapping

from occ_model.arrays import Pixels
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.projection import check_size, paint, panel_corners
from occ_model.effects.plan import plan
from occ_model.results import Frame, Plan
from occ_model.scene.argument_checks import check_choice, check_seed
from occ_model.scene.scene import Scene, check_scene
from occ_model.scene.simulation_settings import NOISE_SOURCES, TOLERANCE, NoiseSource, Observable
from occ_model.simulation.columns import expose_columns
from occ_model.simulation.pixels import PixelExposure
from occ_model.simulation.stage_timer import StageClock


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
        many times faster. All noise then shares its numbers: the fixed pattern is not fixed.

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
    check_scene(scene)
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
        image = paint(enhanced, corners, scene.camera.rows, to_bytes(columns.around))
        clock.done("image")
    else:
        exposure = PixelExposure(scene, chosen, columns, clock)
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
    check_size(scene.camera)
    clock = StageClock()
    columns = expose_columns(scene, chosen, clock)
    exposure = PixelExposure(scene, chosen, columns, clock)
    return exposure.observed(chosen.observable, seed, noise)
