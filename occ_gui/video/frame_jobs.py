"""Background work on one frame: take it from the film, simulate it, read it, and make pictures."""

from dataclasses import dataclass, replace

import numpy as np

import occ_model as occ
from occ_gui.simulation.snapshot import ColumnView, PictureView
from occ_gui.video.frame_views import FrameStory, ShownPicture
from occ_model.arrays import FloatArray
from occ_model.errors import OccError
from occ_model.light.sent import period_columns
from occ_model.receiver.signal import column_means
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, Region
from occ_model.results.video import Video, VideoFrame
from occ_model.scene.light_words import describe_light
from occ_model.scene.recording import Recording
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.video.decode_film import scene_of_frames
from occ_model.video.read_frame import read_by_itself

_MOST_DRAFT_PIXELS = 1_000_000  # up to this size, an exact picture takes no longer than a draft


@dataclass(frozen=True, eq=False, slots=True)
class FrameRequest:
    film: Video | None  # the film; None if there is only the simulated film
    live: VideoFrame | None  # the frame of a live film, which does not keep frames
    index: int
    scene: Scene
    settings: SimulationSettings
    recording: Recording
    # A draft of the simulated frame has one of this many rows; 1 for the exact picture
    draft_step: int = 1


@dataclass(frozen=True, eq=False, slots=True)
class ShownFrame:
    request: FrameRequest
    time: float | None  # when the frame began, in seconds; None if there is no frame
    film: ShownPicture | None
    simulated: ShownPicture | None
    refusal: str  # why there is no simulated picture; empty if there is one
    story: FrameStory | None


def process_frame(request: FrameRequest) -> ShownFrame:
    """Take a frame from its film, simulate the frame with the same number, and read both."""
    film, title, frame, scene = None, "", request.live, request.scene
    if frame is None and request.film is not None:
        frame = request.film.frame(request.index)
        scene = scene_of_frames(request.film, scene)
    story = None
    if frame is not None:
        title = "" if request.film is None else request.film.title
        story = _make_story(frame, scene, title)
        caption = f"{title}: {_describe_time(frame)}"
        film = ShownPicture(frame.image, story.reading.region, caption)
    simulated, refusal, simulated_frame, step = None, "", None, _step_of(request)
    start = None if story is None else start_of(story.reading.results[PAPER_DECODER], request.scene)
    try:
        simulated_frame = _simulate(request, step, start)
    except OccError as error:
        refusal = str(error)
    if simulated_frame is not None and simulated_frame.scene is not None:
        simulated_story = _make_story(simulated_frame, simulated_frame.scene, "Simulated", step)
        when = _describe_time(simulated_frame) if start is None else "in phase with the film"
        caption = f"Simulated{' (draft)' * (step > 1)}: {when}"
        region = simulated_story.reading.region
        simulated = ShownPicture(simulated_frame.image, region, caption, step)
        story = story or simulated_story
    first_frame = simulated_frame if frame is None else frame
    time = None if first_frame is None else first_frame.time
    return ShownFrame(request, time, film, simulated, refusal, story)


def _describe_time(frame: VideoFrame) -> str:
    return f"frame {frame.index + 1}, {frame.time:.4f} s"


def start_of(decoded: DecodeResult, scene: Scene) -> float | None:
    """Return the start time, within a packet, with which the scene sends what was read.

    None if another code was read than the scene sends, or if the decoder does not say where a
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
    # An edge lies before the first column beyond the threshold. A threshold that is not midway
    # between the levels shifts rising and falling edges in opposite directions; their mean stays.
    columns = region.first_column + starts[changes] - 0.5
    chips = changes - decoded.headers[0]
    packet_start = float(np.mean(columns * camera.readout_time - chips * period))
    # The level crosses the threshold when half of the exposure lies behind the edge.
    return float(-(packet_start + camera.exposure_time / 2.0) % (len(occ.packet(scene)) * period))


def _simulate(request: FrameRequest, step: int, start: float | None) -> VideoFrame:
    """Simulate the frame with the film's index, or a frame that starts at the film's phase."""
    scene = request.scene
    if start is not None:
        scene = scene.replace(start_time=start)
    video = occ.render_video(
        scene, None, request.recording, settings=request.settings, rows_step=step,
    )  # fmt: skip
    return video.frame(request.index if start is None else 0)


def _step_of(request: FrameRequest) -> int:
    """Return of how many rows one is simulated; 1 for a picture that a draft makes no faster."""
    camera = request.scene.camera
    if camera.rows * camera.columns <= _MOST_DRAFT_PIXELS:
        return 1
    return min(request.draft_step, camera.rows)


def _make_story(
    frame: VideoFrame, scene: Scene, source_name: str, step: int | None = None
) -> FrameStory:
    """Read one frame with its scene.

    ``step``: of how many rows one was simulated; None for a frame that was filmed.
    """
    image, is_simulated = frame.image, step is not None
    step = step or 1
    size = (scene.camera.rows if step > 1 else image.shape[0]), image.shape[1]
    decoded, is_enhanced = read_by_itself(image, scene)
    region = decoded.region or Region(0, image.shape[0], 0, image.shape[1])
    profile = column_means(image, Region(region.first_row, region.last_row, 0, image.shape[1]))
    decoded = _scale_to_picture(decoded, step, size[0])
    region = decoded.region or Region(0, size[0], 0, size[1])
    corners = _corners_of(region)
    transmitter = scene.transmitter
    has_payload = transmitter.light == "code" and not transmitter.pattern
    reading = ColumnView(
        scene=scene.replace(rows=size[0], columns=size[1]), profile=profile,
        signal=profile, corners=corners, results={decoded.decoder: decoded},
        sent=transmitter.payload_bits if is_simulated and has_payload else (),
        period_columns=period_columns(scene),
    )  # fmt: skip
    picture = PictureView(image, range(0, size[0], step), size, corners)
    # Without this note, its threshold would seem to contradict that in the mode Explore.
    treatment = "enhanced" if is_enhanced else "not enhanced"
    place = f"{source_name}, frame {frame.index + 1}"
    title = f"{place}, read by itself, {treatment}: {_describe_result(decoded)}"
    if transmitter.light != "code":
        title = f"{place}: {describe_light(transmitter)}"
    return FrameStory(picture, reading, is_simulated, title)


def _describe_result(decoded: DecodeResult) -> str:
    if decoded.failure is not None:
        return decoded.failure
    return f"{decoded.payload or f'code {decoded.code}'} read."


def _scale_to_picture(decoded: DecodeResult, step: int, rows: int) -> DecodeResult:
    """Give the region of a draft the rows of the whole picture, of which there are ``rows``."""
    region = decoded.region
    if region is None or step == 1:
        return decoded
    last = min(region.last_row * step, rows)
    region = replace(region, first_row=region.first_row * step, last_row=last)
    return replace(decoded, region=region)


def _corners_of(region: Region) -> FloatArray:
    left, right = region.first_column - 0.5, region.last_column - 0.5
    top, bottom = region.first_row - 0.5, region.last_row - 0.5
    return np.array([[left, top], [right, top], [right, bottom], [left, bottom]])
