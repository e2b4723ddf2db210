"""Compare the lamps found in simulated photographs with those that are there."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from simulated_photos import photo_of

import occ_model as occ
from photo_world.lamp_scenes import LampScene, Thing, lamp_scene

OVERLAP = 0.4
"""Least intersection over union of two rectangles that count as the same lamp."""

FREQUENCY = 0.01


@dataclass
class Score:
    """Counts of lamps: there, found, found with the right frequency, reported, invented.

    A lamp that is marked as doubtful counts as found (and in ``found_doubtful``) if it is real, and
    as ``doubtful_invented``, not as invented, if it is not.
    """

    there: int = 0
    found: int = 0
    right: int = 0
    reported: int = 0
    invented: int = 0
    found_doubtful: int = 0
    surely_wrong: int = 0
    doubtful_invented: int = 0
    steady: int = 0
    steady_found: int = 0
    wrong_scenes: list[int] = field(default_factory=list)

    def add(self, seed: int, scene: LampScene, lamps: Iterable[occ.Lamp]) -> None:
        """Count the lamps of a scene; each lamp found is matched with one real lamp at most."""
        lamps = list(lamps)
        blinking = [lamp for lamp in lamps if lamp.modulated]
        before = self.found, self.right, self.invented + self.doubtful_invented
        unmatched = list(blinking)
        for thing in scene.lamps:
            best = max(unmatched, key=lambda lamp: overlap(thing, lamp.region), default=None)
            if best is None or overlap(thing, best.region) < OVERLAP:
                continue
            unmatched.remove(best)
            self.found += 1
            self.found_doubtful += best.is_doubtful
            assert best.switching_frequency_times_readout is not None
            ratio = best.switching_frequency_times_readout * counted_chip(thing)
            is_right = abs(ratio - 1.0) < FREQUENCY
            self.right += is_right
            self.surely_wrong += not is_right and not best.is_doubtful
        self.there += len(scene.lamps)
        self.reported += len(blinking)
        doubtful = sum(lamp.is_doubtful for lamp in unmatched)
        self.doubtful_invented += doubtful
        self.invented += len(unmatched) - doubtful
        for thing in scene.constant:
            self.steady += 1
            self.steady_found += any(
                overlap(thing, lamp.region) > OVERLAP for lamp in lamps if not lamp.modulated
            )
        wanted = before[0] + len(scene.lamps), before[1] + len(scene.lamps), before[2]
        if (self.found, self.right, self.invented + self.doubtful_invented) != wanted:
            self.wrong_scenes.append(seed)

    def lines(self) -> list[str]:
        """Write the score."""
        there = max(self.there, 1)
        return [
            f"lamps found: {100 * self.found / there:.1f} % of {self.there}",
            f"of these marked as doubtful: {self.found_doubtful}",
            f"frequency within {100 * FREQUENCY:g} %: {100 * self.right / there:.1f} %",
            f"frequency wrong, and not doubtful: {self.surely_wrong}",
            f"invented: {100 * self.invented / max(self.reported, 1):.1f} % of {self.reported}",
            f"invented but marked as doubtful: "
            f"{100 * self.doubtful_invented / max(self.reported, 1):.1f} %",
            f"lamps of constant light found: {self.steady_found} of {self.steady}",
            f"scenes with a mistake: {self.wrong_scenes}",
        ]


def counted_chip(thing: Thing) -> float:
    """Return the columns of a chip; a pulse that repeats counts as two chips a cycle."""
    pulses = sum(
        on > before for before, on in zip(thing.wave, thing.wave[1:] + thing.wave[:1], strict=True)
    )
    return thing.chip * len(thing.wave) / 2 if pulses == 1 else thing.chip


def overlap(thing: Thing, region: occ.Region) -> float:
    """Return the intersection of two rectangles over their union."""
    top, bottom, left, right = thing.box
    rows = min(bottom, region.last_row) - max(top, region.first_row)
    columns = min(right, region.last_column) - max(left, region.first_column)
    shared = max(rows, 0.0) * max(columns, 0.0)
    return shared / ((bottom - top) * (right - left) + region.rows * region.columns - shared)


def score_of(seeds: Iterable[int], draw: Callable[[int], LampScene] = lamp_scene) -> Score:
    """Find the lamps of some scenes, and count."""
    score = Score()
    for seed in seeds:
        scene = draw(seed)
        score.add(seed, scene, occ.find_lamps(photo_of(scene.image)))
    return score
