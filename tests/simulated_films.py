"""Random films with all kinds of timing, codes and motion, and their readings with the truth."""

import time
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor

import numpy as np

import occ_model as occ
from occ_model.results.clock import MeasuredValue
from occ_model.scene.payload import bits_of_payload
from occ_model.scene.recording import Recording, Waypoint
from occ_model.study.observation import panel_span
from occ_model.video.period import SentPeriod
from occ_model.video.render import SimulatedVideo, render_video

FILMS = 40

_RATES = (24.0, 25.0, 29.97, 30.0, 50.0, 60.0, 120.0, 240.0)
_BITS = (32, 48, 64, 96, 128, 256, 512, 1024)
_SCHEMES = (
    ("raw", "manchester"),
    ("c-ook", "manchester"),
    ("preamble", "differential-manchester"),
    ("c-ook", "4b6b"),
    ("raw", "4b6b"),
)


@dataclass(frozen=True)
class ShutterTiming:
    """The exact timing of a frame, from which the chips and packets that it shows are counted.

    A frame that starts at s shows the chips that lie completely between the start of its first
    column's exposure and the end of its last one's: chip n if n / f >= s + a t_r and
    (n + 1) / f <= s + b t_r + t, with a and b the first and the last column of the panel.
    """

    scene: occ.Scene
    start: Fraction  # Of column 0's exposure, in seconds

    def whole_chips(self) -> tuple[int, int]:
        """Return the first whole chip, and the one after the last."""
        span = panel_span(self.scene)
        assert span is not None
        camera = self.scene.camera
        frequency = Fraction(self.scene.transmitter.switching_frequency)
        readout = Fraction(camera.readout_time)
        begin = self.start + span.first_column * readout
        end = self.start + (span.last_column - 1) * readout + Fraction(camera.exposure_time)
        return ceil(begin * frequency), floor(end * frequency)

    def whole_packets(self, length: int) -> int:
        """Return how many packets of ``length`` chips the frame shows whole."""
        first, end = self.whole_chips()
        return max(end // length - -(-first // length), 0)


@dataclass(frozen=True)
class Film:
    """A film, and what its receiver knows roughly."""

    scene: occ.Scene
    recording: Recording
    frames: int
    rough: occ.Scene
    seed: int

    def video(self) -> SimulatedVideo:
        """Return the film."""
        settings = occ.SimulationSettings(seed=self.seed)
        return render_video(self.scene, self.frames, self.recording, settings=settings)

    @property
    def truth(self) -> dict[str, float]:
        """The clock, by the clock of the camera."""
        drift = (1.0 + self.recording.transmitter_drift) / (1.0 + self.recording.camera_drift)
        return {
            "switching_frequency": self.scene.transmitter.switching_frequency * drift,
            "readout_time": self.scene.camera.readout_time,
            "gap": self.recording.gap(self.scene),
        }


@dataclass(frozen=True)
class Judged:
    """A reading beside the truth."""

    film: Film
    reading: occ.VideoReading
    all_seen: bool
    is_right: bool
    milliseconds: float

    def error(self, name: str) -> tuple[float, float]:
        """Return a value of the clock minus the true one, and the stated error."""
        assert self.reading.clock is not None, self.reading.failure
        measured: MeasuredValue = getattr(self.reading.clock, name)
        return measured.value - self.film.truth[name], measured.error


def film(number: int, seconds: float = 5.0) -> Film:
    """Return a film; its number is the seed of all random values."""
    random = np.random.default_rng(2100 + number)
    rate = _RATES[number % len(_RATES)]
    gap = float(random.uniform(0.02, 0.4))
    columns = int(random.choice([720, 1080, 1920]))
    readout = round((1.0 - gap) / rate / columns, 9)
    chip = float(random.uniform(7.0, 22.0))
    frequency = round(1.0 / (chip * readout), 1)
    framing, line_code = _SCHEMES[number % len(_SCHEMES)]
    bits = random.integers(0, 2, _BITS[int(random.integers(len(_BITS)))])
    scene = occ.load_preset("phone-68us").replace(
        rows=48,
        columns=columns,
        readout_time=readout,
        switching_frequency=frequency,
        exposure_time=float(random.uniform(0.2, 0.9)) / frequency,
        payload="bits:" + "".join(map(str, bits)),
        framing=framing,
        line_code=line_code,
        panel_width=0.8,
        panel_height=1.5,
        distance=float(random.uniform(0.45, 1.2)),
        start_time=float(random.uniform(0.0, 1.0)),
        iso=400.0,
    )
    jitter = float(random.choice([0.0, 2e-5, 1e-4]))
    recording = Recording(
        frame_rate=rate,
        frame_jitter=min(jitter, 0.99 * (1.0 / rate - columns * readout) / 6.0),
        camera_drift=float(random.uniform(-1e-4, 1e-4)),
        transmitter_drift=float(random.uniform(-1e-4, 1e-4)),
        path=_path(random, seconds),
        frame_times="nominal" if random.random() < 0.5 else "measured",
    )
    rough = scene.replace(
        readout_time=readout * (1.0 + float(random.uniform(-4e-3, 4e-3))),
        switching_frequency=frequency * (1.0 + float(random.uniform(-2e-3, 2e-3))),
    )
    # Films of one seed would share their jitter and noise.
    return Film(scene, recording, round(seconds * rate), rough, seed=number + 1)


def _path(random: np.random.Generator, seconds: float) -> tuple[Waypoint, ...]:
    """Return the path of a panel that is held in a hand, or no path."""
    if random.random() < 0.4:
        return ()
    times = np.arange(0.0, seconds + 0.5, 0.5)
    return tuple(
        Waypoint(
            float(at), offset_x=float(random.normal(0.0, 0.02)),
            offset_y=float(random.normal(0.0, 0.02)), distance=float(random.normal(0.0, 0.01)),
        )
        for at in times
    )  # fmt: skip


def judge(one: Film) -> Judged:
    """Read a film, and compare the result with the truth."""
    video = one.video()
    reader = occ.VideoReader(one.rough)
    seen: list[ShutterTiming] = []
    used = 0.0
    for frame in video:
        start = time.process_time()
        reader.add(frame)
        used += time.process_time() - start
        assert frame.scene is not None
        assert frame.start is not None
        seen.append(ShutterTiming(frame.scene, frame.start))
    start = time.process_time()
    reading = reader.reading()
    used += time.process_time() - start
    counts = np.zeros(SentPeriod(one.scene.transmitter).length, dtype=np.int64)
    for timing in seen:
        first, end = timing.whole_chips()
        np.add.at(counts, np.arange(first, end) % len(counts), 1)
    right = reading.bits.tolist() == list(bits_of_payload(one.scene.transmitter.payload))
    return Judged(one, reading, bool((counts > 0).all()), right, 1e3 * used / one.frames)
