#!/usr/bin/env bash
# Raw pictures of a simulated rolling shutter have to be stored with their number of bits, for a decoder asks which
# level is white. cxx-image-io reads and writes DNG by its own table, and its page has an example for mosaics
# of 12 bits: a pixel precision of 12. One would expect a DNG whose white is 4095, and which it reads. White
# is 65535 in the file, so that LibRaw takes the brightest light for a sixteenth of full scale; only a white
# level that is set beside the precision helps. And the file says that its picture is to be cropped to
# 0 by 0 pixels: the library itself ends the program when it reads it, LibRaw minds nothing.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet cxx-image-io==1.1.7 rawpy==0.28.0 tifffile==2026.3.3 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import rawpy
import tifffile
from cxx_image_io import ImageLayout, ImageMetadata, ImageWriter, PixelType, read_image, write_image

print("Python", sys.version.split()[0], "cxx-image-io", version("cxx-image-io"), "LibRaw", rawpy.libraw_version)
mosaic = (np.arange(480 * 640).reshape(480, 640) % 4096).astype(np.uint16)
path = Path("lines.dng")
for white_level in (None, 4095):
    metadata = ImageMetadata()
    metadata.fileInfo.pixelType = PixelType.BAYER_RGGB
    metadata.fileInfo.imageLayout = ImageLayout.PLANAR
    metadata.fileInfo.pixelPrecision = 12
    if white_level:
        metadata.calibrationData.whiteLevel = white_level
    write_image(path, mosaic, ImageWriter.Options(metadata))
    with rawpy.imread(str(path)) as raw:
        same, white = bool(np.array_equal(raw.raw_image_visible, mosaic)), raw.white_level
    with tifffile.TiffFile(path) as file:
        crop = file.pages[0].tags["DefaultCropSize"].value
    try:
        own = f"the picture, equal: {np.array_equal(read_image(path)[0], mosaic)}"
    except SystemExit as error:
        own = f"SystemExit: {error}"
    print(f"white level set: {white_level}; LibRaw reads the same numbers: {same}, white {white}, expected 4095")
    print("   crop size:", crop, "expected: 640 by 480; cxx-image-io reads:", own)
    assert same and white == (white_level or 65535) and crop == (0, 0, 0, 0) and own.startswith("SystemExit")
PYTHON
