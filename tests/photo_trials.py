"""Matches of simulated photos: their errors and their verdicts."""

from dataclasses import dataclass

import numpy as np
from photo_world.negatives import negative
from simulated_photos import random_scene, take

import occ_model as occ
from occ_model.photo.fit.chip_runs import canonical
from occ_model.scene.scene import Scene

SHORTEST_VIEW, LONGEST_VIEW = 1.5, 20.0
"""Fewest and most periods in view in photos whose chips are read."""


@dataclass(frozen=True)
class MatchErrors:
    """The errors of the match of one photo."""

    seed: int
    exposure_in_chips: float
    failure: str = ""
    readout_error: float = np.inf
    exposure_error: float = np.inf
    deviations: tuple[float, ...] = ()
    doubts: tuple[str, ...] = ()

    @property
    def is_sure(self) -> bool:
        """Whether there is a match without any doubt."""
        return not self.failure and not self.doubts


def match_seed(seed: int) -> MatchErrors:
    """Simulate a photo and match it; only what was sent, and how fast, is known."""
    scene = random_scene(seed)
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    in_chips = camera.exposure_time * frequency
    told = scene.replace(readout_time=1e-6, exposure_time=1.0, start_time=0.0)
    try:
        match = occ.match_photo(take(scene, seed), told)
    except occ.MatchError as why:
        return MatchErrors(seed, in_chips, str(why))
    period = len(match.pattern) / frequency
    late = (match.start_time - scene.model.start_time + period / 2) % period - period / 2
    off = {
        "readout_time": match.readout_time - camera.readout_time,
        "exposure_time": match.exposure_time - camera.exposure_time,
        "start_time": late,
    }
    return MatchErrors(
        seed,
        in_chips,
        readout_error=abs(off["readout_time"]) / camera.readout_time,
        exposure_error=abs(off["exposure_time"]) / camera.exposure_time,
        deviations=tuple(abs(off[name]) / match.uncertainties[name] for name in off),
        doubts=match.reasons,
    )


@dataclass(frozen=True)
class Judgement:
    """The verdict of the match of one picture."""

    seed: int
    what: str
    verdict: str  # ``"sure"``, ``"doubtful"`` or ``"refused"``
    why: str
    is_scene_pattern: bool  # whether the found chips are those of the scene
    is_right: bool  # whether the found chips are those sent, up to rotation


def judge_negative(seed: int) -> Judgement:
    """Match a picture without the stripes of an LED to a preset."""
    kind, photo = negative(seed)
    return _judge(seed, kind, photo, occ.load_preset("phone-136us"), "")


def judge_other_code(seed: int) -> Judgement:
    """Match a photo of one code to a scene with another."""
    scene = random_scene(seed)
    apart = 1 + seed % (2**scene.transmitter.bits - 1)
    other = (scene.transmitter.code + apart) % 2**scene.transmitter.bits
    return _judge(
        seed, "other code", take(scene, seed), _hide(scene.replace(code=other)), _pattern_of(scene)
    )


def judge_unknown_chips(seed: int) -> Judgement:
    """Match a photo of 1.5 to 20 periods, of which half are saturated, without its chips."""
    random = np.random.default_rng((417, seed))
    scene = random_scene(seed)
    view = scene.pose.distance / scene.camera.focal_length_pixels
    columns = min(float(scene.value("panel_width")) / view, float(scene.camera.columns))
    least, most = columns / LONGEST_VIEW, columns / SHORTEST_VIEW
    period = 24.0 / (scene.transmitter.switching_frequency * scene.camera.readout_time)
    longer = float(np.clip(period, 1.05 * least, 0.9 * most)) / period
    scene = scene.replace(
        switching_frequency=scene.transmitter.switching_frequency / longer,
        exposure_time=scene.camera.exposure_time * longer,
    )
    if seed % 2:
        brighter = float(random.uniform(1.2, 4.0))
        scene = scene.replace(luminance=float(scene.value("luminance")) * brighter)
    photo = take(scene, seed)
    what = "saturated" if seed % 2 else "not saturated"
    return _judge(seed, what, photo, _hide(scene), _pattern_of(scene), sent="read")


def _hide(scene: Scene) -> Scene:
    """Replace the values that a match has to find."""
    return scene.replace(readout_time=1e-6, exposure_time=1e-3, start_time=0.0)


def _pattern_of(scene: Scene) -> str:
    return _rotate("".join(map(str, occ.packet(scene).tolist())))


def _rotate(pattern: str) -> str:
    return "".join(map(str, canonical(np.array(list(pattern), dtype=np.uint8)).tolist()))


def _judge(
    seed: int, what: str, photo: occ.Photo, scene: Scene, truth: str, sent: str = "auto"
) -> Judgement:
    try:
        match = occ.match_photo(photo, scene, sent=sent)
    except occ.MatchError as error:
        return Judgement(seed, what, "refused", str(error), is_scene_pattern=False, is_right=False)
    found = _rotate(match.pattern)
    why = " ".join(match.reasons)
    return Judgement(seed, what, match.verdict, why, found == _pattern_of(scene), found == truth)
