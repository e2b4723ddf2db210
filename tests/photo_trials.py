"""Simulated photos, matched: how far off what is found is, and what is said of them."""

from dataclasses import dataclass

import numpy as np
from photo_world.negatives import negative
from simulated_photos import random_scene, take

import occ_model as occ
from occ_model.photo.fit.chip_runs import canonical
from occ_model.scene.scene import Scene

SHORTEST_VIEW, LONGEST_VIEW = 1.5, 20.0
"""Periods in view of the photos whose chips are to be read."""


@dataclass(frozen=True)
class Found:
    """How far off one photo's match is."""

    seed: int
    exposure_in_chips: float
    failure: str = ""
    readout: float = np.inf
    exposure: float = np.inf
    deviations: tuple[float, ...] = ()
    doubts: tuple[str, ...] = ()

    @property
    def is_sure(self) -> bool:
        """Whether there is a match without any doubt."""
        return not self.failure and not self.doubts


def round_trip(seed: int) -> Found:
    """Simulate a photo and match it, told what was sent and how fast, and nothing else."""
    scene = random_scene(seed)
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    in_chips = camera.exposure_time * frequency
    told = scene.replace(readout_time=1e-6, exposure_time=1.0, start_time=0.0)
    try:
        match = occ.match_photo(take(scene, seed), told)
    except occ.MatchError as why:
        return Found(seed, in_chips, str(why))
    period = len(match.pattern) / frequency
    late = (match.start_time - scene.model.start_time + period / 2) % period - period / 2
    off = {
        "readout_time": match.readout_time - camera.readout_time,
        "exposure_time": match.exposure_time - camera.exposure_time,
        "start_time": late,
    }
    return Found(
        seed,
        in_chips,
        readout=abs(off["readout_time"]) / camera.readout_time,
        exposure=abs(off["exposure_time"]) / camera.exposure_time,
        deviations=tuple(abs(off[name]) / match.uncertainties[name] for name in off),
        doubts=match.reasons,
    )


@dataclass(frozen=True)
class Said:
    """What a match says of one picture."""

    seed: int
    what: str
    verdict: str  # ``"sure"``, ``"doubtful"`` or ``"refused"``
    why: str
    scene_s: bool  # whether the scene's chips are said to be sent
    right: bool  # whether the chips are those sent, up to rotation


def said_of_negative(seed: int) -> Said:
    """Match a picture without the stripes of an LED to a preset."""
    kind, photo = negative(seed)
    return _said(seed, kind, photo, occ.load_preset("phone-136us"), "")


def said_of_other_code(seed: int) -> Said:
    """Match a photo of one code to a scene with another."""
    scene = random_scene(seed)
    apart = 1 + seed % (2**scene.transmitter.bits - 1)
    other = (scene.transmitter.code + apart) % 2**scene.transmitter.bits
    return _said(
        seed, "other code", take(scene, seed), _told(scene.replace(code=other)), _sent(scene)
    )


def said_of_unknown_chips(seed: int) -> Said:
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
    return _said(seed, what, photo, _told(scene), _sent(scene), sent="read")


def _told(scene: Scene) -> Scene:
    """Take away what is to be found."""
    return scene.replace(readout_time=1e-6, exposure_time=1e-3, start_time=0.0)


def _sent(scene: Scene) -> str:
    return _turned("".join(map(str, occ.packet(scene).tolist())))


def _turned(pattern: str) -> str:
    return "".join(map(str, canonical(np.array(list(pattern), dtype=np.uint8)).tolist()))


def _said(
    seed: int, what: str, photo: occ.Photo, scene: Scene, truth: str, sent: str = "auto"
) -> Said:
    try:
        match = occ.match_photo(photo, scene, sent=sent)
    except occ.MatchError as error:
        return Said(seed, what, "refused", str(error), scene_s=False, right=False)
    found = _turned(match.pattern)
    why = " ".join(match.reasons)
    return Said(seed, what, match.verdict, why, found == _sent(scene), found == truth)
