"""Read the three colours of a picture by a colour camera.

Each colour is read from its own pixels, which demosaicing leaves as they are. They are those of a
monochrome camera (:meth:`occ_model.Scene.colour`), so that any decoder reads their column means. If
a filter lets the light of other LEDs through, the means are first unmixed by the inverse of the
mixing matrix. In columns without pixels of a channel, a cubic through the four nearest columns with
such pixels gives its light.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.mosaic import mosaic_of
from occ_model.camera.photometry import WHITE
from occ_model.errors import DecodeInputError, ParameterError
from occ_model.receiver.csk import read_symbols
from occ_model.receiver.decode import decoder_named, read_with
from occ_model.receiver.signal import column_means, locate
from occ_model.results.colour import ColourReading
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, Location, Region
from occ_model.scene.colour_scenes import check_colour
from occ_model.scene.parameters.colour import COLOURS, CSK_ORDERS
from occ_model.scene.scene import Scene

_CUBIC = np.array([-1.0, 0.0, 9.0, 16.0, 9.0, 0.0, -1.0]) / 16.0
"""Half-way between samples by the cubic through four of them, and the samples themselves."""


def decode_colours(
    image: NDArray[np.uint8], scene: Scene, decoder: str = PAPER_DECODER
) -> ColourReading:
    """Read the codes of three LEDs, or a packet of colours.

    Parameters
    ----------
    image : ndarray of uint8, shape (rows, columns, 3) or (rows, columns)
        Red, green and blue, or a raw mosaic, with the columns as scan axis and the Bayer pattern's
        first pixel first.
    scene
        What the receiver knows, with the Bayer pattern and the mixing matrix.
    decoder
        A name from :func:`occ_model.decoders`; colour shift keying has a receiver of its own.

    Raises
    ------
    DecodeInputError
        The image is not of this kind.
    ParameterError
        The scene has no colour camera or contradicts itself, or the decoder does not exist.
    """
    check_colour(scene)
    decoder_named(decoder)
    signals = colour_signals(image, scene)
    if signals is None:
        failure = "No panel found: all pixels have nearly the same grey level."
        return ColourReading((DecodeResult(decoder, failure=failure),) * 3, None)
    kind = scene.colours.colour_light
    if kind in CSK_ORDERS:
        return ColourReading((read_symbols(signals.light(), scene),), signals.region)
    results = (
        replace(read_with(decoder, signal, scene.colour(colour)), region=signals.region)
        for colour, signal in zip(COLOURS, signals.own(), strict=True)
    )
    return ColourReading(tuple(results), signals.region)


@dataclass(frozen=True, eq=False, slots=True)
class ColourSignals:
    """The column means of each colour's pixels on the panel."""

    scene: Scene
    region: Region
    # Shape (3, columns): mean grey levels of each channel; NaN in columns without its pixels
    greys: FloatArray

    @property
    def lights(self) -> FloatArray:
        """Light of each mean, which is one of grey levels, as decoders of one colour take it."""
        return np.asarray((self.greys / WHITE) ** self.scene.camera.gamma)

    def own(self) -> list[FloatArray]:
        """Return the grey levels of each LED, in the columns with pixels of its colour."""
        seen = ~np.isnan(self.greys)
        if not self.scene.colours.mixes:
            return [row[has] for row, has in zip(self.greys, seen, strict=True)]
        tone = 1.0 / self.scene.camera.gamma
        greys = WHITE * np.maximum(self.light(), 0.0) ** tone
        return [row[has] for row, has in zip(greys, seen, strict=True)]

    def light(self) -> FloatArray:
        """Return the light of each LED in every column, unmixed; that of white is 1."""
        gains = np.array(self.scene.colours.gains)[:, None]
        filled = np.array([_interpolate(row) for row in self.lights]) / gains
        return np.asarray(np.linalg.solve(np.array(self.scene.colours.matrix), filled))


def colour_signals(image: NDArray[np.uint8], scene: Scene) -> ColourSignals | None:
    """Find the panel and return the means of its pixels by column; None if there is none."""
    places = _places_of(image, scene)
    location = _locate(places, scene)
    return None if location is None else _signals_in(location.region, places, scene)


def _places_of(image: NDArray[np.uint8], scene: Scene) -> list[ByteArray]:
    """Return the pixels at each of the four places of the Bayer pattern, arrays of one shape."""
    mosaic = mosaic_of(_check_image(image), scene)
    rows, columns = (size // 2 for size in mosaic.shape)
    return [mosaic[own][:rows, :columns] for _, own in scene.colours.filters]


def _locate(places: list[ByteArray], scene: Scene) -> Location | None:
    # If one LED alone is lit, the mean of the four would be as dark as the noise beside the panel.
    brightest = np.maximum(np.maximum(*places[:2]), np.maximum(*places[2:]))
    return locate(brightest, scene.receiver.bright_fraction)


def _signals_in(part: Region, places: list[ByteArray], scene: Scene) -> ColourSignals:
    """Return the means of a region, which is given in pairs of rows and columns."""
    means = np.full((3, 2 * part.columns), np.nan)
    for pixels, (channel, (_, columns)) in zip(places, scene.colours.filters, strict=True):
        means[channel, columns] = column_means(pixels, part)
    ends = part.first_row, part.last_row, part.first_column, part.last_column
    return ColourSignals(scene, Region(*(2 * end for end in ends)), means)


def _check_image(image: NDArray[np.uint8]) -> ByteArray:
    image = np.asarray(image)
    is_picture = image.ndim == 2 or (image.ndim == 3 and image.shape[2] == 3)
    if image.dtype != np.uint8 or not is_picture or min(image.shape[:2]) < 2:
        raise DecodeInputError(
            "Three colours are read from 8-bit pixels of shape (rows, columns, 3), or a raw mosaic "
            f"(rows, columns), of at least 2 x 2, not from {image.dtype} of shape {image.shape}."
        )
    return image


def _interpolate(row: FloatArray) -> FloatArray:
    """Fill the columns without samples, which are every second one or none."""
    missing = np.isnan(row)
    if not missing.any():
        return row
    padded = np.pad(row, 4, mode="reflect")  # keeps a sample in every second column
    return np.convolve(np.nan_to_num(padded), _CUBIC, mode="same")[4:-4]


def measure_mixing(pictures: list[NDArray[np.uint8]], scene: Scene) -> Scene:
    """Return the scene with the mixing matrix measured in a calibration stage.

    Parameters
    ----------
    pictures
        Four pictures of one camera: with the red, the green and the blue LED alone steadily lit,
        and with none.

    Raises
    ------
    ParameterError
        The light of the four pictures gives no matrix that can be inverted.
    DecodeInputError
        A picture is not from a colour camera, or shows no panel, or their sizes differ.
    """
    if len(pictures) != 4:
        raise ParameterError.of("pictures", f"{len(pictures)}", "4: red, green, blue and none lit")
    # A picture without colours, as of no light, is read as grey.
    sizes = [_check_image(picture).shape[:2] for picture in pictures]
    if len(set(sizes)) > 1:
        raise DecodeInputError(
            "The four pictures of a calibration must have the same rows and columns, not "
            f"{', '.join(map(str, sizes))}."
        )
    places = [_places_of(picture, scene) for picture in pictures]
    location = _locate(places[1], scene)
    if location is None:
        raise DecodeInputError("The picture of the green LED shows no panel.")
    lights = [_signals_in(location.region, each, scene).lights for each in places]
    means = np.array([np.nanmean(each, axis=1) for each in lights]) / scene.colours.gains
    matrix = np.array([mean - means[3] for mean in means[:3]]).T
    matrix = np.maximum(matrix / max(float(matrix.sum(axis=1).max()), 1e-9), 0.0)
    text = " / ".join(" ".join(f"{number:.5f}" for number in row) for row in matrix)
    return scene.replace(mixing=text)
