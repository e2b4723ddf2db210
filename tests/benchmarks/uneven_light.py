"""How exactly a film's readout time is measured where its light is uneven.

python tests/benchmarks/uneven_light.py [films of each kind, default 20]

A film has 25 frames of random chips, 30 to 150 of them in view, exposed for 0.2 to 1.5 chips. Its
lit fractions are computed apart from the program, and their frequency is known.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from lit_fractions import lit_fractions

from occ_model.arrays import FloatArray
from occ_model.video.chip_timing import ChipLattice, fit_timing
from occ_model.video.phase_fit import Phases, mean_step

Random = np.random.Generator

_COLUMNS, _FRAMES, _FIRST_SEED = 1080, 25, 100
_PLACE = np.linspace(-1.0, 1.0, _COLUMNS)


def _lens(centre: float, random: Random) -> FloatArray:
    angle = np.arctan(random.uniform(0.5, 1.2) * (_PLACE - centre))
    return np.asarray(np.cos(angle) ** 4)


def _shadow(centre: float, random: Random) -> FloatArray:
    return 0.4 + 0.6 / (1.0 + np.exp(-(_PLACE - centre) / random.uniform(0.15, 0.4)))


def _ripple(centre: float, random: Random) -> FloatArray:
    phase = 2.0 * np.pi * random.uniform(1.5, 3.0) * _PLACE + 9.0 * centre
    return np.asarray(1.0 + 0.15 * np.sin(phase))


LIGHT: dict[str, Callable[[float, Random], FloatArray]] = {
    "nearly even": lambda _, random: 1.0 + 0.1 * random.uniform(-1.0, 1.0) * _PLACE,
    "a lens's fall-off": _lens,
    "a round lamp": lambda _, random: np.sqrt(1.0 - (random.uniform(0.7, 0.95) * _PLACE) ** 2),
    "a soft shadow": _shadow,
    "fall with the distance": lambda centre, random: (
        1.0 / (1.0 + ((_PLACE - centre) / random.uniform(0.25, 0.5)) ** 2)
    ),
    "ripples": _ripple,
    "a hot spot": lambda centre, random: (
        0.3 + np.exp(-0.5 * ((_PLACE - centre) / random.uniform(0.1, 0.25)) ** 2)
    ),
}
"""The light of the lit lamp along the columns, by a centre from -0.4 to 0.4."""


@dataclass(frozen=True)
class Measured:
    error: float  # of the chips a column, relative
    deviation: float  # as stated, relative


def measured(kind: str, seed: int) -> Measured:
    """Draw a film, and measure how many chips lie on a column."""
    random = np.random.default_rng([list(LIGHT).index(kind), seed])
    step = 30.0 * 5.0 ** random.uniform() / _COLUMNS
    exposure, noise = random.uniform(0.2, 1.5), random.choice([0.003, 0.01, 0.03])
    light, dark = LIGHT[kind](random.uniform(-0.4, 0.4), random), random.uniform(0.0, 0.3)
    steps, errors = [], []
    for _ in range(_FRAMES):
        chips = random.integers(0, 2, int(step * _COLUMNS) + 10, dtype=np.uint8)
        phase = 2.0 + random.uniform()
        lit = lit_fractions(chips, phase + step * np.arange(_COLUMNS), exposure)
        columns = dark + light * lit + noise * random.standard_normal(_COLUMNS)
        roughly = step * (1.0 + 1e-3 * random.standard_normal())
        shifted = phase + random.uniform(-0.3, 0.3)
        rough = ChipLattice(roughly, shifted, 0.95 * exposure, 0, chips)
        timing = fit_timing(columns, rough)
        if timing is not None:
            steps.append(timing.lattice.step)
            errors.append(timing.step_error)
    none = np.zeros(len(steps))
    phases = Phases(none, none, none, none, np.array(steps), np.array(errors), 1.0)
    mean, deviation = mean_step(phases)
    return Measured(mean / step - 1.0, deviation / step)


def row(name: str, films: list[Measured]) -> str:
    """Write a row of the table, in millionths and percent."""
    error = np.abs([film.error for film in films])
    stated = np.array([film.deviation for film in films])
    median, usual, largest = 1e6 * np.array([np.median(error), np.median(stated), error.max()])
    within = [f"{100.0 * float(np.mean(error < count * stated)):.0f} %" for count in (1, 2)]
    return (
        f"| {name} | {len(films)} | {float(f'{median:.2g}'):g} | {float(f'{usual:.2g}'):g} | "
        f"{largest:.0f} | "
        f"{', '.join(within)} | {float(np.max(error / stated)):.1f} |"
    )


def main(films: int) -> None:
    print("| light | films | median error | stated | largest error | within 1, 2 | most |")
    print("|---|---|---|---|---|---|---|")
    every: list[Measured] = []
    for kind in LIGHT:
        found = [measured(kind, seed) for seed in range(_FIRST_SEED, _FIRST_SEED + films)]
        print(row(kind, found), flush=True)
        every += found
    print(row("all", every))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
