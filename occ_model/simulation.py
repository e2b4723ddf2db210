"""From a scene to a frame: the stages in the order light travels, each one timed."""

from time import perf_counter

from occ_model.camera.enhancement import enhance, to_bytes
from occ_model.camera.photometry import column_profile, level_values
from occ_model.camera.projection import paint, panel_corners
from occ_model.checks import check_seed, check_tolerance
from occ_model.results import Frame
from occ_model.scene import Scene


def render(scene: Scene, *, tolerance: float = 0.5, seed: int = 1) -> Frame:
    """Simulate the picture that the scene's camera takes.

    The paper's model is all that a scene can call for so far: nothing in it can be left out and
    nothing is random, so that every tolerance and every seed give the same frame.

    Parameters
    ----------
    scene
        The scene.
    tolerance
        How much, in levels of the stretched profile, effects left out may change; infinity
        allowed.
    seed
        Of all that is random.

    Returns
    -------
    Frame

    Raises
    ------
    ParameterError
        The tolerance or the seed is negative, or no number.
    ProjectionError
        Part of the panel is behind the camera, or the image would be too large.
    """
    check_tolerance(tolerance)
    check_seed(seed)
    clock = _StageClock()
    # The corners first: they cost nothing, and a pose without a picture is refused at once.
    corners = panel_corners(scene)
    clock.stage_done("projection")
    profile = column_profile(scene)
    clock.stage_done("exposure")
    enhanced = enhance(profile, scene.model.enhancement)
    clock.stage_done("enhancement")
    surroundings = int(to_bytes(level_values(scene))[0])
    image = paint(enhanced, corners, scene.camera.rows, surroundings)
    clock.stage_done("image")
    return Frame(scene, image, profile, enhanced, corners, clock.timings)


class _StageClock:
    """Notes how long each stage took."""

    def __init__(self) -> None:
        self.timings: dict[str, float] = {}
        self._last = perf_counter()

    def stage_done(self, stage: str) -> None:
        now = perf_counter()
        self.timings[stage] = now - self._last
        self._last = now
