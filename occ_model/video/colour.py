"""Read a film for the codes of three LEDs, each as a film of the pixels with its colour."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.photometry import WHITE
from occ_model.errors import ParameterError
from occ_model.receiver.colour import colour_signals
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.video import Video
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.colour_scenes import check_colour
from occ_model.scene.parameters.colour import COLOURS, CSK_ORDERS
from occ_model.scene.scene import Scene
from occ_model.video.decode_film import reader_of

_ROWS = 16  # of an LED's picture; rounded differently, they keep means to 1/16 of a grey level


def decode_colour_video(
    video: Video,
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    readout_tolerance: float | None = None,
    frequency_tolerance: float | None = None,
    progress: Callable[[str, FilmProgress], object] = lambda _colour, _progress: None,
) -> dict[str, VideoReading]:
    """Read a film in three colours.

    Parameters
    ----------
    video
        A film of ``render_video``, or of ``load_video`` with the channel ``"colours"``. Its pixels
        are those of the sensor, not scaled.
    scene
        What the receiver knows, with the Bayer pattern and the mixing matrix.
    decoder, readout_tolerance, frequency_tolerance
        As for :func:`occ_model.decode_video`.
    progress
        Called with each colour after each frame.

    Returns
    -------
    dict
        What each LED that sends a code has sent, by its colour: ``"red"``, ``"green"``, ``"blue"``.

    Raises
    ------
    ParameterError
        As for :func:`occ_model.decode_video`, or the light is colour shift keying, which is read
        from single pictures only.
    VideoError
        The file cannot be read.
    """
    check_colour(scene)
    light = scene.colours.colour_light
    if light in CSK_ORDERS:
        raise ParameterError.of(
            "colour_light", light, "three-codes, white, red, green or blue", condition="for a film"
        )
    readers = {
        colour: reader_of(
            video, scene.colour(colour), decoder,
            readout_tolerance=readout_tolerance, frequency_tolerance=frequency_tolerance,
        )
        for colour in ((light,) if light in COLOURS else COLOURS)
    }  # fmt: skip
    for frame in video:
        for colour, picture in zip(COLOURS, _pictures_of(frame.image, scene), strict=True):
            if colour in readers:
                seen = replace(frame, image=picture, samples=None, scene=None)
                progress(colour, readers[colour].add(seen))
    return {colour: reader.reading() for colour, reader in readers.items()}


def _pictures_of(image: ByteArray, scene: Scene) -> Iterator[ByteArray]:
    """Yield a picture for each LED: its own light in the panel's columns, and black elsewhere."""
    signals = colour_signals(image, scene)
    rounding_offsets = np.arange(0.5, _ROWS)[:, None] / _ROWS
    for place, colour in enumerate(COLOURS):
        step = 1 if colour == "green" else 2  # columns from one pixel of the colour to the next
        first = scene.colours.first_pixel(colour)[1] % step
        picture = np.zeros((_ROWS, len(range(first, image.shape[1], step))), np.uint8)
        if signals is not None:
            own = signals.own()[place]
            start = signals.region.first_column // step
            values = np.clip(np.floor(own + rounding_offsets), 0, WHITE)
            picture[:, start : start + len(own)] = values
        yield picture
