"""Reading of a film in the background, with a regular summary of all frames."""

from collections import deque
from dataclasses import dataclass
from time import monotonic

import numpy as np
from PySide6.QtCore import QObject, Signal

import occ_model as occ
from occ_gui.background.task import Report, Task
from occ_gui.video.film_reading import FilmReading, Marks, MarkState
from occ_model.errors import inflect
from occ_model.results.film_sentence import describe_film
from occ_model.results.sent_packets import PacketReading, SentPackets
from occ_model.results.video import Video, VideoFrame
from occ_model.results.video_reading import FilmProgress, FrameReading, VideoReading
from occ_model.scene.scene import Scene
from occ_model.study.reading_facts import film_facts
from occ_model.video.decode_film import reader_of

_INTERVAL = 0.1  # seconds between two reports, so that the window can draw each of them
_LIVE_INTERVAL = 0.03  # seconds between two reports of a camera, which also show its picture
_JOINT_INTERVAL = 1.0  # least seconds between two readings of all frames together
_JOINT_FRACTION = 0.2  # largest fraction of the time spent on reading all frames together
MOST_LIVE = 900  # frames of a live film that are kept: half a minute at 30 frames a second
MOST_MARKS = 1_000_000  # up to this number of packets, each has a mark of its own


@dataclass(frozen=True, eq=False, slots=True)
class ReadingRequest:
    film: Video
    scene: Scene
    is_live: bool = False  # whether the film has no end, so that only its last frames are kept


def read_film(request: ReadingRequest, report: Report) -> FilmReading:
    """Read a film from its first frame to its last, and report a FilmReading now and then."""
    collector, last = _Collector(request), monotonic()
    interval = _LIVE_INTERVAL if request.is_live else _INTERVAL
    for frame in request.film:
        report(None)
        collector.add(frame)
        if monotonic() - last >= interval:
            report(collector.summarize())
            last = monotonic()
    collector.read_together()
    return collector.summarize()


class _Collector:
    def __init__(self, request: ReadingRequest) -> None:
        most_frames = MOST_LIVE if request.is_live else None
        self._request = request
        self._times: deque[float] = deque(maxlen=most_frames)
        self._states: deque[int] = deque(maxlen=most_frames)
        self._reader = self._new_reader()
        self._frames = 0
        self._progress: FilmProgress | None = None
        self._joint_reading: VideoReading | None = None
        self._packets = self._earlier_packets = Marks()
        self._next_joint_reading = monotonic() + _JOINT_INTERVAL

    def _new_reader(self) -> occ.VideoReader:
        return reader_of(self._request.film, self._request.scene)

    def add(self, frame: VideoFrame) -> None:
        if self._request.is_live and self._frames == MOST_LIVE:
            # A new reader, because the memory of the old one grows with every frame.
            self.read_together()
            self._reader, self._frames = self._new_reader(), 0
            self._earlier_packets = self._packets
        self._progress = self._reader.add(frame)
        self._frames += 1
        self._times.append(frame.time)
        self._states.append(state_of_frame(self._progress.frame))
        if monotonic() >= self._next_joint_reading:
            self.read_together()

    def read_together(self) -> None:
        """Read all frames together, because later frames tell the places of earlier ones."""
        if not self._frames:
            return
        start = monotonic()
        self._joint_reading = self._reader.reading()
        for place, frame in enumerate(reversed(self._joint_reading.frames), 1):
            if place > len(self._states):
                break
            self._states[-place] = state_of_frame(frame)
        new_packets = marks_of_packets(self._joint_reading.packets)
        self._packets = _join_marks(self._earlier_packets, new_packets, self._times[0])
        duration = monotonic() - start
        self._next_joint_reading = monotonic() + max(_JOINT_INTERVAL, duration / _JOINT_FRACTION)

    def summarize(self) -> FilmReading:
        progress = self._progress
        if progress is None:
            problem = self._request.film.problem
            return FilmReading(sentences=(problem,) if problem else ())
        reading, text = self._joint_reading, progress.payload
        if reading is not None and reading.payload and len(reading.frames) == progress.frames:
            text = reading.payload
        return FilmReading(
            times=np.array(self._times, dtype=np.float64),
            states=np.array(self._states, dtype=np.uint8),
            packets=self._packets,
            text=text,
            answer=describe_film(progress, reading),
            facts=film_facts(progress, reading),
            sentences=sentences_of(progress, reading, self._request.film.problem),
        )


def state_of_frame(frame: FrameReading) -> MarkState:
    """Return the state of a frame: whether its chips were read, and their place is known."""
    if frame.place is not None:
        return MarkState.READ
    return MarkState.UNCHECKED if frame.chips.size else MarkState.LOST


def state_of_packet(packet: PacketReading) -> MarkState:
    if not packet.is_read or packet.correct is False:
        return MarkState.LOST
    return MarkState.UNCHECKED if packet.correct is None else MarkState.READ


def marks_of_packets(packets: SentPackets) -> Marks:
    """Return a mark for each packet; if there are very many, lost packets share a mark."""
    numbers = np.array([packet.number for packet in packets.in_view], dtype=np.int64)
    if len(packets) <= MOST_MARKS:
        edges = np.arange(len(packets) + 1)
    else:
        ends = np.cumsum([0, *(part.count for part in packets.parts)])
        edges = np.unique(np.concatenate([numbers, numbers + 1, ends]))
    states = np.full(len(edges) - 1, MarkState.LOST, dtype=np.uint8)
    states[np.searchsorted(edges, numbers)] = [
        state_of_packet(packet) for packet in packets.in_view
    ]
    starts, last = packets.starts(edges[:-1]), packets.starts(edges[1:] - 1)
    return Marks(starts, last + packets.steps(edges[:-1]), states)


def _join_marks(before: Marks, after: Marks, first: float) -> Marks:
    """Join two sequences of marks, and drop the marks that end before ``first``."""
    if not len(before):
        return after
    last = float(after.starts[0]) if len(after) else np.inf
    is_kept = (before.ends > first) & (before.starts < last)
    return Marks(
        np.concatenate([before.starts[is_kept], after.starts]),
        np.concatenate([before.ends[is_kept], after.ends]),
        np.concatenate([before.states[is_kept], after.states]),
    )


def sentences_of(
    progress: FilmProgress, reading: VideoReading | None, problem: str | None
) -> tuple[str, ...]:
    sentences = [problem] if problem else []
    if reading is not None:
        sentences += [*reading.problems, *filter(None, [reading.faults])]
    elif progress.clock is not None:
        sentences += progress.clock.problems
    if reading is not None and reading.cut_off:
        sentences.append(_explain_losses(progress, reading))
    return tuple(dict.fromkeys(sentences))


def _explain_losses(progress: FilmProgress, reading: VideoReading) -> str:
    """Explain which packets were lost; their bits do not count as wrong."""
    where = "sent between two frames, or cut off by a frame's edge"
    if unplaced := progress.frames - progress.placed:
        where += f", or in {inflect(unplaced, 'frame')} without a known place"
    text = f"Lost: {inflect(reading.cut_off, 'packet')} {where}."
    if misread := reading.lost - reading.cut_off:
        text += f" Misread: {inflect(misread, 'packet')}."
    return text + " The bit error rate counts only packets in view."


class FilmReader(QObject):
    """Reads one film at a time; the result grows while the film is read."""

    changed = Signal()  # there is more to show, the reading has ended, or the film is another one
    failed = Signal(str)  # why the rest of a film cannot be read; what was read stays

    def __init__(self) -> None:
        super().__init__()
        self.reading = FilmReading()
        self._request: ReadingRequest | None = None
        self.is_done = False
        self.task: Task[ReadingRequest, FilmReading] = Task(
            read_film, "reading of the film", impatient=True
        )
        self.task.reported.connect(self._on_report)
        self.task.finished.connect(self._on_end)
        self.task.failed.connect(self._on_failure)

    @property
    def is_running(self) -> bool:
        return not self.task.is_idle

    @property
    def scene(self) -> Scene | None:
        return None if self._request is None else self._request.scene

    def start(self, film: Video, scene: Scene, is_live: bool = False) -> None:
        self._request, self.is_done = ReadingRequest(film, scene, is_live), False
        self.reading = FilmReading()
        self.task.ask(self._request)
        self.changed.emit()

    def cancel(self) -> None:
        if not self.task.is_idle:
            self.task.cancel()
            self.changed.emit()

    def forget(self) -> None:
        self.task.cancel()
        self._request, self.is_done = None, False
        self.reading = FilmReading()
        self.changed.emit()

    def _on_report(self, reading: FilmReading) -> None:
        self.reading = reading
        self.changed.emit()

    def _on_end(self, reading: FilmReading) -> None:
        self.reading, self.is_done = reading, True
        self.changed.emit()

    def _on_failure(self, sentence: str) -> None:
        self.failed.emit(sentence)
        self.changed.emit()
