"""Matches of photographs whose truth is known: how far off they are, by what they state."""

from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from both_cores import on_both_cores
from simulated_photos import photo_of

import occ_model as occ
from photo_world.bounds import bound_of_light, bound_of_picture
from photo_world.foreign import READOUT, foreign
from photo_world.hot_lamps import hot_lamps
from photo_world.photograph import KNOWN_GAMMA, World, photograph, random_world

SATURATION_THIRDS = (0.0, 0.2, 0.4, 0.6)
"""Fractions of saturated pixels that divide the photographs."""


@dataclass(frozen=True)
class Trial:
    """One photograph, matched."""

    world: World | int  # its truth; or the number by which it is drawn
    saturated: float  # fraction of the lamp's pixels that are white
    readout_error: float = np.nan  # relative, as are the three below
    exposure_error: float = np.nan
    readout_deviation: float = np.nan  # standard deviation, as the match states it
    exposure_deviation: float = np.nan
    # Doubts, exposure_doubts: why the match is not sure, and why its exposure time alone is not.
    doubts: tuple[str, ...] = ()
    exposure_doubts: tuple[str, ...] = ()
    failure: str = ""  # why there is none
    duty_error: float = np.nan  # of a pulse
    duty_deviation: float = np.nan  # standard deviation, where the duty was not taken as given

    @property
    def seed(self) -> int:
        """The number by which it is drawn."""
        return self.world if isinstance(self.world, int) else self.world.seed

    # light_bounds, picture_bounds: relative standard deviations of readout and exposure that no
    # unbiased estimate can fall below: by light alone, and by the stored picture with the unknowns
    # that a match has.
    @cached_property
    def light_bounds(self) -> tuple[float, float]:
        return (np.nan, np.nan) if isinstance(self.world, int) else bound_of_light(self.world)

    @cached_property
    def picture_bounds(self) -> tuple[float, float]:
        return (np.nan, np.nan) if isinstance(self.world, int) else bound_of_picture(self.world)

    @property
    def is_sure(self) -> bool:
        """Whether there is a match without any doubt but for its exposure time."""
        return not self.failure and not self.doubts

    def is_sure_of(self, what: str) -> bool:
        """Whether an estimate, ``"readout"`` or ``"exposure"``, is sure."""
        return self.is_sure and (what == "readout" or not self.exposure_doubts)


def told(world: World) -> occ.Scene:
    """Return the scene of what is known of a photograph: the chips and their frequency."""
    return _told(world.chips, world.switching_frequency)


def _told(chips: str, frequency: float) -> occ.Scene:
    return occ.load_preset("phone-68us").replace(
        pattern=chips, switching_frequency=frequency, gamma=KNOWN_GAMMA,
        readout_time=1e-6, exposure_time=1.0, start_time=0.0,
    )  # fmt: skip


def trial(world: World) -> Trial:
    """Take a photograph and match it."""
    image = photograph(world)
    covers = world.lamp.covers(world.rows, world.columns)
    saturated = float(np.mean(image[covers] >= 254))
    return _matched(
        world, saturated, image, told(world), "scene", world.readout_time, world.exposure_time
    )


def trial_of(seed: int) -> Trial:
    """Draw a world, take a photograph of it and match that."""
    return trial(random_world(seed))


def hot_trial_of(seed: int) -> Trial:
    """Match the photograph of one lamp as it is found in a room; what it sends is known."""
    drawn = hot_lamps(seed)
    ((sent,), (lamp,)) = drawn.sent, drawn.lamps
    top, bottom, left, right = (max(0, round(side)) for side in lamp.box)
    saturated = float(np.mean(drawn.image[top:bottom, left:right] >= 254))
    is_pulse = "01" not in sent.chips
    chips = "10" if is_pulse else sent.chips
    chip = len(sent.chips) * sent.chip / len(chips)
    duty = sent.chips.count("1") / len(sent.chips) if is_pulse else np.nan
    scene = _told(chips, 1.0 / (chip * READOUT))
    exposure = drawn.exposure * READOUT
    return _matched(seed, saturated, drawn.image, scene, "auto", READOUT, exposure, duty)


def foreign_trial_of(seed: int) -> Trial:
    """Match the photograph by another camera; what was sent is known."""
    drawn = foreign(seed)
    saturated = float(np.mean(drawn.image >= 254))
    scene = _told(drawn.chips, 1.0 / (drawn.chip * READOUT))
    exposure = drawn.exposure * READOUT
    return _matched(seed, saturated, drawn.image, scene, "scene", READOUT, exposure)


def _matched(
    world: World | int,
    saturated: float,
    image: np.ndarray,
    scene: occ.Scene,
    sent: str,
    readout: float,
    exposure: float,
    duty: float = np.nan,
) -> Trial:
    """Match a photograph, and compare what is found with its true readout, exposure and duty."""
    try:
        match = occ.match_photo(photo_of(image), scene, sent=sent)
    except occ.MatchError as why:
        return Trial(world, saturated, failure=str(why))
    return Trial(
        world,
        saturated,
        match.readout_time / readout - 1.0,
        match.exposure_time / exposure - 1.0,
        match.uncertainties["readout_time"] / readout,
        match.uncertainties["exposure_time"] / exposure,
        doubts=match.reasons,
        exposure_doubts=match.exposure_reasons,
        duty_error=np.nan if match.duty is None else match.duty - duty,
        duty_deviation=match.uncertainties.get("duty", np.nan),
    )


WORLDS = {
    "wide": partial(on_both_cores, trial_of),
    "lamps": partial(on_both_cores, hot_trial_of),
    "foreign": partial(on_both_cores, foreign_trial_of),
}
"""Matches of the photographs of some seeds, by the world that they are drawn from."""
