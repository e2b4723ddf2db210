"""Jobs that search for limits, for worker processes; nothing here needs Qt."""

from dataclasses import dataclass

from occ_model.parallel.job import Heartbeat
from occ_model.results.bit_errors import MostBits
from occ_model.results.limits import Advice, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study.limits import advice_of, limits
from occ_model.study.most_bits import most_bits
from occ_model.study.success_rate import check_rate
from occ_model.study.working_range import rough_range


@dataclass(frozen=True, slots=True)
class RoughAnswer:
    """The frequencies that a decoder reads, from one picture at each."""

    decoder: str
    frequencies: WorkingRange


def advise_roughly(
    scene: Scene, settings: RateSettings, decoder: str, rate: float, _heartbeat: Heartbeat
) -> RoughAnswer:
    check_rate(scene, settings)
    return RoughAnswer(decoder, rough_range(scene, "switching_frequency", rate, settings))


def advise(
    scene: Scene, settings: RateSettings, decoder: str, rate: float, heartbeat: Heartbeat
) -> Advice:
    """Find the limits of a decoder's working range, and the theoretical limits."""
    found_limits = limits(
        scene, decoder, rate=rate, images=settings.images, seed=settings.seed,
        tolerance=settings.tolerance, force=settings.force, path=settings.path, heartbeat=heartbeat,
    )  # fmt: skip
    return advice_of(found_limits)


def search_most_bits(
    scene: Scene, decoder: str, frames_a_second: float, heartbeat: Heartbeat
) -> MostBits:
    most_frames = 1.0 / (scene.camera.columns * scene.camera.readout_time)
    frame_rate = min(frames_a_second, most_frames)
    (best,) = most_bits(scene, (decoder,), frames_a_second=frame_rate, heartbeat=heartbeat)
    return best
