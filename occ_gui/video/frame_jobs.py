"""Jobs of one frame: take it from the film, simulate it, read it, and make its pictures."""

from dataclasses import dataclass, replace

import numpy as np

import occ_model as occ
from occ_gui.simulation.snapshot import ColumnView, PictureView, halves_of
from occ_gui.video.frame_views import FrameStory, ShownPicture
from occ_model.arrays import ByteArray, FloatArray
from occ_model.errors import OccError
from occ_model.receiver.signal import column_means
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, Region
from occ_model.results.video import Video, VideoFrame
from occ_model.scene.recording import Recording
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.video.read_frame import read_by_itself

_MOST_DRAFT_PIXELS = 1_000_000  # pixels of a picture up to which it is simulated as soon as a draft


@dataclass(frozen=True, eq=False, slots=True)
class FrameRequest:
    film: Video | None  # the film, None where there is only the simulated one
    live: VideoFrame | None  # the frame of a live film, which keeps none
    index: int
    scene: Scene
    settings: SimulationSettings
    recording: Recording
    # A draft of the simulated frame shows one of so many rows; 1 for the exact picture
    draft_step: int = 1


@dataclass(frozen=True, eq=False, slots=True)
class ShownFrame:
    request: FrameRequest
    time: float | None  # when the frame began, in seconds; None where there is none
    film: ShownPicture | None
    simulated: ShownPicture | None
    instead: str
    story: FrameStory | None


def shown_frame(request: FrameRequest) -> ShownFrame:
    """Take a frame from its film, simulate the one of the same number, and read both."""
    film, title, frame = None, "", request.live
    if frame is None and request.film is not None:
        frame = request.film.frame(request.index)
    story = None
    if frame is not None:
        title = "" if request.film is None else request.film.title
        story = _story(frame, request.scene, None, title)
        film = _shown(frame.image, story, f"{title}: {_at(frame)}")
    simulated, instead, own = None, "", None
    start = None if story is None else start_of(story.reading.results[PAPER_DECODER], request.scene)
    try:
        own = _simulated(request, start)
    except OccError as error:
        instead = str(error)
    if own is not None and own.scene is not None:
        step = len(range(0, request.scene.camera.rows, request.draft_step))
        is_draft = step != request.scene.camera.rows
        seen = _story(own, own.scene, request, "Simulated")
        when = _at(own) if start is None else "in phase with the film"
        simulated = _shown(own.image, seen, f"Simulated{' (draft)' * is_draft}: {when}")
        story = story or seen
    time = frame.time if frame is not None else None if own is None else own.time
    return ShownFrame(request, time, film, simulated, instead, story)


def _at(frame: VideoFrame) -> str:
    return f"frame {frame.index + 1}, {frame.time:.4f} s"


def start_of(decoded: DecodeResult, scene: Scene) -> float | None:
    """Return the start time with which the scene sends what was read: seconds below a packet's.

    None where another code was read than the scene sends, or the decoder does not say where a
    packet begins.
    """
    transmitter, region = scene.transmitter, decoded.region
    starts = decoded.chip_starts
    if transmitter.pattern or starts is None or region is None or not decoded.headers:
        return None
    if tuple(decoded.bits.tolist()) != transmitter.payload_bits:
        return None
    camera, period = scene.camera, transmitter.switching_period
    changes = np.flatnonzero(np.diff(decoded.chips)) + 1
    if not changes.size:
        return None
    # The edge lies before the first column beyond the threshold. Where it is not in the middle of
    # the levels, it moves rising and falling edges apart: their mean stays.
    columns = region.first_column + starts[changes] - 0.5
    chips = changes - decoded.headers[0]
    begin = float(np.mean(columns * camera.readout_time - chips * period))
    # A chip is read from where the exposure has passed over its edge by half.
    return float(-(begin + camera.exposure_time / 2.0) % (len(occ.packet(scene)) * period))


def _simulated(request: FrameRequest, start: float | None) -> VideoFrame:
    """Simulate the frame of the film's number, or one that begins at the same phase."""
    camera, scene = request.scene.camera, request.scene
    step = request.draft_step if camera.rows * camera.columns > _MOST_DRAFT_PIXELS else 1
    if start is not None:
        scene = scene.replace(start_time=start)
    video = occ.render_video(
        scene, None, request.recording, settings=request.settings,
        rows_step=min(step, camera.rows),
    )  # fmt: skip
    return video.frame(request.index if start is None else 0)


def _shown(image: ByteArray, story: FrameStory, caption: str) -> ShownPicture:
    step = story.picture.rows.step
    region = story.reading.region
    return ShownPicture(image, halves_of(image), region, caption, step)


def _story(frame: VideoFrame, scene: Scene, request: FrameRequest | None, whose: str) -> FrameStory:
    """Read one frame by its scene, which is a simulated frame's own, with its request."""
    image = frame.image
    step = 1
    if request is not None and image.shape[0] != scene.camera.rows:
        step = request.draft_step
    decoded, is_enhanced = read_by_itself(image, scene)
    region = decoded.region or Region(0, image.shape[0], 0, image.shape[1])
    profile = column_means(image, Region(region.first_row, region.last_row, 0, image.shape[1]))
    shown = _with_size(scene, image, step)
    decoded = _in_whole_picture(decoded, step, shown.camera.rows)
    region = decoded.region or Region(0, shown.camera.rows, 0, image.shape[1])
    corners = _corners(region)
    transmitter = scene.transmitter
    chip_columns = transmitter.switching_period / scene.camera.readout_time
    is_known = request is not None and not transmitter.pattern
    reading = ColumnView(
        scene=shown, profile=profile, signal=profile, corners=corners,
        results={decoded.decoder: decoded},
        sent=transmitter.payload_bits if is_known else (),
        packet_columns=chip_columns * len(occ.packet(scene)),
    )  # fmt: skip
    rows, size = range(0, shown.camera.rows, step), (shown.camera.rows, shown.camera.columns)
    picture = PictureView(image, rows, size, corners, image)
    # Else its threshold would seem to contradict that of Explore, which is of an enhanced picture.
    how = "enhanced" if is_enhanced else "not enhanced"
    title = f"{whose}, frame {frame.index + 1}, read by itself, {how}: {_in_words(decoded)}"
    return FrameStory(picture, reading, request is not None, title)


def _in_words(decoded: DecodeResult) -> str:
    if decoded.failure is not None:
        return decoded.failure
    return f"{decoded.payload or f'code {decoded.code}'} read."


def _with_size(scene: Scene, image: ByteArray, step: int) -> Scene:
    rows, columns = image.shape
    rows = scene.camera.rows if step > 1 else rows
    if (rows, columns) == (scene.camera.rows, scene.camera.columns):
        return scene
    return scene.replace(rows=rows, columns=columns)


def _in_whole_picture(decoded: DecodeResult, step: int, rows: int) -> DecodeResult:
    region = decoded.region
    if region is None or step == 1:
        return decoded
    last = min(region.last_row * step, rows)
    region = replace(region, first_row=region.first_row * step, last_row=last)
    return replace(decoded, region=region)


def _corners(region: Region) -> FloatArray:
    left, right = region.first_column - 0.5, region.last_column - 0.5
    top, bottom = region.first_row - 0.5, region.last_row - 0.5
    return np.array([[left, top], [right, top], [right, bottom], [left, bottom]])
