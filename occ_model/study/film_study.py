"""Measure and calculate the packets received in films, over frequency, gap and packet length.

For each point a film is simulated and read. The packets that frames show whole are also counted in
exact arithmetic; the difference is the loss of the receiver.

One of these films is the example of CamComSim, a published simulator of films: frames of 33.3 ms
with a gap of 0.2, 8,000 chips per second, and repeated packets of 4 start chips, 8 bits of header
and 16 of payload in Manchester code (``vlc-citi-lab/camcomsim``, ``simu_params_template.json``).
Its 52 chips are the same as those of 24 bits after the header 1 1 1 0.

A frame that starts at s shows the chips that lie completely between the start of its first column's
exposure and the end of its last one's: chip n if n / f >= s + a t_r and (n + 1) / f <= s + b t_r +
t, with a and b the first and the last column of the panel. This count needs no simulation: it is
what a receiver without errors could read.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import ceil, floor

import numpy as np

from occ_model.errors import ParameterError
from occ_model.results.decoding import PAPER_DECODER
from occ_model.scene.argument_checks import check_count, check_seed
from occ_model.scene.recording import Recording
from occ_model.scene.scene import Scene, check_scene
from occ_model.study.observation import panel_span
from occ_model.transmitter.scheme import check_code
from occ_model.video.period import SentPeriod
from occ_model.video.reader import VideoReader
from occ_model.video.render import SimulatedVideo, render_video


@dataclass(frozen=True, slots=True)
class ShutterTiming:
    """The exact timing of a scene, from which packets are counted."""

    frequency: Fraction  # Chips per second
    # In seconds
    exposure_time: Fraction
    readout_time: Fraction
    # The first and the last column that show the panel
    first: int
    last: int

    @classmethod
    def of(cls, scene: Scene, columns: tuple[int, int]) -> "ShutterTiming":
        """Return a scene's timing; ``columns``: the panel's first, and the one after its last."""
        first, end = columns
        return cls(
            Fraction(scene.transmitter.switching_frequency),
            Fraction(scene.camera.exposure_time),
            Fraction(scene.camera.readout_time),
            first,
            end - 1,
        )

    @property
    def view(self) -> Fraction:
        """Time from the start of the first column's exposure to the end of the last one's."""
        return (self.last - self.first) * self.readout_time + self.exposure_time

    def whole_chips(self, start: Fraction) -> tuple[int, int]:
        """Return the first whole chip and the one after the last; ``start``: of column 0, in s."""
        begin = (start + self.first * self.readout_time) * self.frequency
        return ceil(begin), floor(begin + self.view * self.frequency)

    def whole_packets(self, start: Fraction, length: int) -> int:
        """Return how many packets of ``length`` chips a frame shows whole."""
        first, end = self.whole_chips(start)
        return max(end // length - -(-first // length), 0)


def mean_packets_received(timing: ShutterTiming, frame_period: Fraction, length: int) -> Fraction:
    """Return the fraction of packets that frames show whole, averaged over the start time.

    A view of V >= L chips contains on average (V - L) / L whole packets of L chips.
    """
    view = timing.view * timing.frequency
    return max(view - length, Fraction(0)) / (timing.frequency * frame_period)


MOST_POINTS = 10_000

_LARGEST_GAP = 0.9  # largest fraction of a frame period that a gap may take


@dataclass(frozen=True, slots=True)
class FilmRequest:
    # The scene; its readout time follows from the gap, and its payload from the number of bits
    scene: Scene
    frequencies: tuple[float, ...]  # Switching frequencies in Hz
    gaps: tuple[float, ...]  # Gaps as fractions of the frame period, from 0
    bits: tuple[int, ...]  # Numbers of bits of a payload
    frame_rate: float = 30.0  # In Hz
    frames: int = 120
    decoder: str = PAPER_DECODER
    seed: int = 1

    def __post_init__(self) -> None:
        check_scene(self.scene)
        check_code(self.scene.transmitter)
        check_seed(self.seed)
        check_count("frames", self.frames, 3, 1_000_000)
        for gap in self.gaps:
            if not 0.0 <= gap <= _LARGEST_GAP:
                raise ParameterError.of(
                    "gap", f"{100.0 * gap:g} % of a frame", f"0 to {100 * _LARGEST_GAP:g} %"
                )
        check_count("points", self.point_count, 1, MOST_POINTS)
        for number in self.bits:
            check_count("bits", number, 1, 4096)
        Recording(frame_rate=self.frame_rate)

    @property
    def point_count(self) -> int:
        return len(self.frequencies) * len(self.gaps) * len(self.bits)

    def scene_at(self, frequency: float, gap: float, bits: int, seed: int) -> Scene:
        """Return the scene of a point, with a random payload and start time."""
        random = np.random.default_rng(seed)
        payload = "bits:" + "".join(map(str, random.integers(0, 2, bits).tolist()))
        readout = (1.0 - gap) / self.frame_rate / self.scene.camera.columns
        return self.scene.replace(
            switching_frequency=frequency,
            readout_time=readout,
            payload=payload,
            pattern="",
            start_time=float(random.uniform(0.0, 1.0)),
        )


@dataclass(frozen=True, slots=True)
class FilmPoint:
    # Switching frequency in Hz, gap as a fraction of the frame period, bits of the payload
    frequency: float
    gap: float
    bits: int
    packet_chips: int
    # Packets sent during the film, those read correctly, and those that are whole in a frame by
    # exact counting
    packets: int
    read: int
    counted: int
    # Fraction of packets that frames show whole, averaged over the start time
    on_average: float
    bits_per_second: float  # Payload bits per second in the packets read, repeats included
    # Seconds until the whole payload was joined; None if it never was
    complete_at: float | None
    is_right: bool  # Whether the joined payload equals the one that was sent
    failure: str | None  # Why the scene could not be filmed or read; None if it could
    faults: str = ""  # How often a plug-in failed; empty if none did

    @property
    def reception(self) -> float:
        """Fraction of the packets that were read correctly; 0 if none was sent."""
        return self.read / self.packets if self.packets else 0.0

    @property
    def counted_reception(self) -> float:
        """Fraction of the packets that are whole in a frame, by exact counting."""
        return self.counted / self.packets if self.packets else 0.0


def film_study(
    request: FilmRequest, heartbeat: Callable[[], object] = lambda: None
) -> Iterator[FilmPoint]:
    """Measure one film after another; gaps vary fastest, then frequencies, then bits."""
    places = product(request.bits, request.frequencies, request.gaps)
    for number, (bits, frequency, gap) in enumerate(places):
        scene = request.scene_at(frequency, gap, bits, request.seed + number)
        yield _measure_film(request, scene, gap, heartbeat)


def _measure_film(
    request: FilmRequest, scene: Scene, gap: float, heartbeat: Callable[[], object]
) -> FilmPoint:
    recording = Recording(frame_rate=request.frame_rate)
    video = render_video(scene, request.frames, recording)
    reader = VideoReader(scene, request.decoder)
    for frame in video:
        heartbeat()
        reader.add(frame)
    reading = reader.reading()
    period = SentPeriod(scene.transmitter)
    timing = _timing(scene)
    length = period.part_length
    # If no frame shows a packet, the number sent still follows from the clock.
    sent = len(reading.packets)
    return FilmPoint(
        frequency=scene.transmitter.switching_frequency,
        gap=gap,
        bits=scene.transmitter.payload_length,
        packet_chips=length,
        packets=sent,
        read=reading.read,
        counted=_count_whole(video, timing, length),
        on_average=float(mean_packets_received(timing, 1 / Fraction(request.frame_rate), length)),
        bits_per_second=reading.bits_per_second,
        complete_at=reading.complete_after,
        is_right=reading.bits.tolist() == list(scene.transmitter.payload_bits),
        failure=reading.failure,
        faults=reading.faults,
    )


def _timing(scene: Scene) -> ShutterTiming:
    span = panel_span(scene)
    if span is None or span.columns == 0:
        raise ParameterError(
            "The panel is turned or out of view; allowed in a study of films: a level panel."
        )
    return ShutterTiming.of(scene, (span.first_column, span.last_column))


def _count_whole(video: SimulatedVideo, timing: ShutterTiming, length: int) -> int:
    """Count the packets that are whole in a frame of the film."""
    starts = (video.start_of(number) for number in range(video.frame_count or 0))
    return sum(timing.whole_packets(start, length) for start in starts)


def scene_of_films(scene: Scene) -> Scene:
    """Return a scene whose panel fills a picture of few rows, whose films are simulated quickly."""
    return scene.replace(
        rows=48, columns=1080, distance=0.4, panel_width=2.0, panel_height=2.0, yaw=0.0, pitch=0.0,
        roll=0.0, offset_x=0.0, offset_y=0.0,
    )  # fmt: skip


def group_points(points: Sequence[FilmPoint]) -> dict[tuple[float, int], list[FilmPoint]]:
    """Group the points by frequency and number of bits, each group in order of the gap."""
    groups: dict[tuple[float, int], list[FilmPoint]] = {}
    for point in points:
        groups.setdefault((point.frequency, point.bits), []).append(point)
    return groups


FRAME_PERIOD = Fraction(333, 10_000)  # seconds from frame to frame
GAP = Fraction(1, 5)  # fraction of the frame period
FREQUENCY = 8000.0
PACKET_CHIPS = 4 + 2 * (8 + 16)

_EXPOSURE = 25e-6  # a fifth of a chip, assumed: the example states no exposure time
_STEP = Fraction(1, 10_000)  # time step of the published simulator in seconds
_ERRORS = Fraction(1, 100)  # fraction of the packets in view that this simulator loses


def example_request(frames: int = 333, seed: int = 1) -> FilmRequest:
    """Return the example as a film; the frames' starts within a packet repeat after 65 frames."""
    scene = scene_of_films(Scene()).replace(
        line_code="manchester", framing="paper", exposure_time=_EXPOSURE, iso=800.0
    )
    return FilmRequest(
        scene,
        frequencies=(FREQUENCY,),
        gaps=(float(GAP),),
        bits=(24,),
        frame_rate=float(1 / FRAME_PERIOD),
        frames=frames,
        seed=seed,
    )


def published_rule() -> Fraction:
    """Return the fraction of packets received according to the rule of the published simulator.

    Its authors state no result. By its rule the time in view is rounded up to whole milliseconds, a
    packet is received if it ends within this time, and one in a hundred of these is lost. The
    starts are spread evenly over a frame because each is shifted at random by up to 0.9 ms.
    """
    frame = round(FRAME_PERIOD / _STEP)
    view = -(-(FRAME_PERIOD * (1 - GAP)) // Fraction(1, 1000)) * 10
    packet = round(PACKET_CHIPS / Fraction(FREQUENCY) / _STEP)
    return Fraction(max(view - packet, 0), frame) * (1 - _ERRORS)
