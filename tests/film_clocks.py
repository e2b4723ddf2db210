"""Films as the phases and stated times of their frames, and the clocks fitted to them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from occ_model.results.clock import ClockSolution, MeasuredValue
from occ_model.video.film_clock import FilmClock, FilmPhases
from occ_model.video.frame_times import fit_frame_times
from occ_model.video.known_timing import CRYSTAL_TOLERANCE, KnownTiming
from occ_model.video.phase_fit import FramePhases

COLUMNS = 1000
RESOLUTIONS = {"exact": 0.0, "MP4": 1 / 90_000, "Matroska": 1e-3, "GIF": 1e-2, "AVI": -1.0}
"""Steps in seconds of the times in containers; AVI counts frames."""

KNOWN = ("lamp", "readout", "neither")
_NOMINAL_RATES = (23.976, 24.0, 25.0, 29.97, 30.0, 50.0, 59.94, 60.0, 119.88, 120.0, 240.0)
_READOUT_GUESS = 0.045  # largest relative error of a rough readout time


@dataclass(frozen=True)
class FilmTruth:
    """A film of a lamp (``period`` 2) or of packets, by the clock of the lamp."""

    frequency: float
    readout: float
    frame_period: float
    frames: int
    period: float
    jitter: float = 0.0
    noise: float = 0.003
    slow_motion: int = 1
    resolution: float = 0.0
    is_nominal: bool = False  # whether equal steps are stated whatever the frames' starts
    camera_clock: float = 0.0  # by how much it is too fast, relative
    seed: int = 1

    def phases(self, known: KnownTiming) -> FilmPhases:
        random = np.random.default_rng(self.seed)
        steady = random.uniform(0.0, 1.0) + np.arange(self.frames) * self.frame_period
        starts = steady + self.jitter * random.standard_normal(self.frames)
        stated = (steady if self.is_nominal else starts) * (1.0 + self.camera_clock)
        stated = self.slow_motion * stated
        resolution = self.resolution
        if resolution < 0.0:
            resolution = self.frame_period * self.slow_motion
            stated = np.arange(self.frames) * resolution
        elif resolution:
            stated = np.round(stated / resolution) * resolution
        stated = stated - stated[0]
        step, count = self.frequency * self.readout, self.frames
        columns = 500.0 + 30.0 * np.sin(np.arange(count))
        places = self.frequency * starts + step * columns
        places = places + self.noise * random.standard_normal(count)
        phases = FramePhases(
            stated, columns, np.mod(places, self.period), np.full(count, self.noise),
            step * (1.0 + 1e-4 * random.standard_normal(count)), np.full(count, 1e-4 * step),
            self.period,
        )  # fmt: skip
        times = fit_frame_times(stated, resolution)
        assert times is not None
        return FilmPhases(phases, times.numbers, times, known, COLUMNS)


@dataclass(frozen=True)
class JudgedClock:
    truth: FilmTruth
    is_lamp_known: bool
    clock: FilmClock

    @property
    def is_sure(self) -> bool:
        return len(self.clock.fits) == 1

    def off(self, name: str) -> float:
        """Return the error of a value of the likeliest clock, in standard errors."""
        return self._off(self.clock.fits[0].values, name)

    @property
    def is_listed(self) -> bool:
        """Whether the true clock is one of those that fit."""
        names = ("switching_frequency", "readout_time")
        return any(
            all(abs(self._off(each.values, name)) < 5.0 for name in names)
            for each in self.clock.fits
        )

    def _off(self, values: ClockSolution, name: str) -> float:
        measured: MeasuredValue = getattr(values, name)
        # By the clock of the camera, where that of the lamp is not known.
        scale = 1.0 if self.is_lamp_known else 1.0 + self.truth.camera_clock
        true = {
            "switching_frequency": self.truth.frequency / scale,
            "readout_time": self.truth.readout * scale,
            "frame_period": self.truth.frame_period * scale,
            "gap": (self.truth.frame_period - COLUMNS * self.truth.readout) * scale,
        }[name]
        return (measured.value - true) / max(measured.error, 1e-12 * abs(true))


def judge_clocks(container: str, known: str, count: int, seed: int = 1) -> Iterator[JudgedClock]:
    """Fit the clocks of random films in a container, with the lamp or the readout time known."""
    for number in range(count):
        random = np.random.default_rng([seed, number, *container.encode(), *known.encode()])
        rate = float(random.choice([*_NOMINAL_RATES, random.uniform(23.976, 240.0)]))
        if RESOLUTIONS[container] * rate > 0.5:
            rate = float(random.uniform(10.0, 50.0))
        is_counted = RESOLUTIONS[container] < 0.0
        period = float(random.choice([2.0, 2.0, 24.0, 52.0, 130.0]))
        readout = float(random.uniform(0.5, 0.97)) / rate / COLUMNS
        frequency = float(random.uniform(0.02, 0.12)) / readout
        truth = FilmTruth(
            frequency, readout, 1.0 / rate, int(random.integers(10, 200)), period,
            jitter=float(random.choice([0.0, 1e-5, 5e-5, 2e-4])) if rate < 100.0 else 0.0,
            resolution=RESOLUTIONS[container],
            is_nominal=is_counted or bool(random.random() < 0.3),
            camera_clock=0.0 if is_counted else float(random.uniform(-1e-4, 1e-4)),
            seed=number,
        )  # fmt: skip
        guess = readout * (1.0 + float(random.uniform(-1.0, 1.0)) * _READOUT_GUESS)
        if known == "lamp":
            stated = frequency * (1.0 + float(random.uniform(-1.0, 1.0)) * CRYSTAL_TOLERANCE)
            knowledge = KnownTiming(stated, guess, CRYSTAL_TOLERANCE, None)
        elif known == "readout":
            knowledge = KnownTiming(1.3 * frequency, guess, None, 0.05)
        else:
            knowledge = KnownTiming(frequency * float(random.uniform(0.9, 1.1)), guess)
        yield JudgedClock(truth, known == "lamp", truth.phases(knowledge).fit_clocks())
