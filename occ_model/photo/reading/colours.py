"""Read the three colours that a camera took, from a picture or from a RAW file's mosaic."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.photometry import WHITE
from occ_model.camera.projection import MAX_PIXELS
from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.photo.reading.file import open_file, open_picture
from occ_model.photo.reading.image_decoding import DECODED_FRACTION, DecodedPicture, take_channel
from occ_model.photo.reading.load import in_grey_levels, turn_upright
from occ_model.photo.reading.raw import MOSAIC, WHITE_SAMPLE, is_raw, read_mosaic
from occ_model.photo.reading.watched_file import Reporter
from occ_model.scene.argument_checks import check_choice


@dataclass(frozen=True, eq=False, slots=True)
class ColourPhoto:
    """The three colours of a photo, with the columns as scan axis.

    Parameters
    ----------
    image : ndarray of uint8, shape (rows, columns, 3) or (rows, columns)
        Red, green and blue; or a raw mosaic in grey levels.
    bayer
        The mosaic's pattern, if the file states it; empty if not.
    """

    image: ByteArray
    bayer: str


def load_colours(path: str | Path, *, gamma: float, scan_axis: str = "auto") -> ColourPhoto:
    """Read a colour photo, or the photosites of a RAW file without demosaicing.

    Parameters
    ----------
    path
        A file as for :func:`occ_model.load_photo`; a grey picture is taken for a raw mosaic.
    gamma
        Exponent of the grey levels that a RAW file's light is converted to.
    scan_axis
        ``"columns"`` or ``"lines"`` of the file; ``"auto"``: the sensor's lines of a RAW file, the
        columns of others, as this program writes them.

    Raises
    ------
    PhotoError
        As for :func:`occ_model.load_photo`; or a RAW file is of a sensor without colours.
    """
    check_choice("scan_axis", scan_axis, SCAN_AXES)
    file, report = Path(path), Reporter(None)
    with open_file(file, MAX_PIXELS, report) as opened:
        if is_raw(opened):
            mosaic = read_mosaic(file, opened, MOSAIC, MAX_PIXELS, report)
            light, pattern = mosaic.all_photosites(), mosaic.pattern
            if scan_axis != "columns":
                light, pattern = light.T, pattern[0::2] + pattern[1::2]  # both are transposed
            table = WHITE * (np.arange(WHITE_SAMPLE + 1.0) / WHITE_SAMPLE) ** (1.0 / gamma)
            return ColourPhoto(np.rint(table).astype(np.uint8)[light], pattern)
        decoded = DecodedPicture(open_picture(file, opened, MAX_PIXELS, DECODED_FRACTION))
        samples, _ = take_channel(decoded, None, report)
    turned = turn_upright(samples, decoded.orientation, scan_axis == "lines")
    return ColourPhoto(in_grey_levels(turned), "")
