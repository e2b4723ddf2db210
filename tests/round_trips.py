"""Photos of known scenes, matched: how far off what is found is."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from both_cores import on_both_cores
from simulated_photos import random_scene, take

import occ_model as occ


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


def round_trips(seeds: Sequence[int]) -> Iterator[Found]:
    """Match many photos."""
    return on_both_cores(round_trip, seeds)
