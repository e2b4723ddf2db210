#!/usr/bin/env bash
# A HEIC may say that its luma has the limited range of video, in which black is 16 and white 235. One would
# expect the same grey levels whether its picture has colours or not. libheif expands the range of colours
# only; grey is returned as it is stored, so that black is 16. Its encoder agrees with that mistake: grey
# from 0 to 255 is stored unchanged under the label "limited", where no other reader would look for it.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pillow-heif==1.8.1 pillow==13.0.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import io
import sys

import numpy as np
import pillow_heif
from PIL import Image

print("Python", sys.version.split()[0], "libheif", pillow_heif.libheif_version())

FULL = np.tile(np.array([0, 64, 128, 192, 255], np.uint8).repeat(64), (64, 1))
LIMITED = np.rint(16 + FULL * (219 / 255)).astype(np.uint8)  # as the standard stores these levels


def read_again(levels, mode):
    """Return the levels of a lossless HEIC that is labelled as of limited range."""
    file = io.BytesIO()
    picture = pillow_heif.from_pillow(Image.fromarray(levels).convert(mode))
    picture.save(file, quality=-1, chroma=444, full_range_flag=0)
    (heif,) = pillow_heif.open_heif(file)
    assert heif.info["nclx_profile"]["full_range_flag"] == 0
    return np.asarray(heif).reshape(64, 5, 64, -1)[32, :, 32, 0].tolist()


grey = read_again(LIMITED, "L")  # the encoder stores grey as it is given
print("16 to 235 in grey, stored:", grey, "expected when read: [0, 64, 128, 192, 255]")
colours = read_again(FULL, "RGB")
print("0 to 255 in colours:", colours, "expected: [0, 64, 128, 192, 255]")
unlike = read_again(FULL, "L")
print("0 to 255 in grey:", unlike, "which a limited range cannot hold without loss")
sys.exit(grey != LIMITED[0, ::64].tolist() or max(abs(a - b) for a, b in zip(colours, FULL[0, ::64])) > 1
         or unlike != FULL[0, ::64].tolist())
PYTHON
