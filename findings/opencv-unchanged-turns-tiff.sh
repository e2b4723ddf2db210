#!/usr/bin/env bash
# OpenCV's IMREAD_UNCHANGED is described to ignore the orientation that a camera noted, and IMREAD_COLOR to
# apply it. One would expect the same of every format. JPEG and PNG are left as they lie. A TIFF is turned:
# whoever applies the orientation afterwards, as is right for other formats, turns it twice, and lines and
# columns, which a rolling shutter tells apart, are exchanged. And imread returns nothing at all for such a
# TIFF, of which imdecode decodes the same bytes.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet opencv-python-headless==5.0.0.93 pillow==13.0.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import cv2
import numpy as np
from PIL import Image

print("Python", sys.version.split()[0], "OpenCV", cv2.__version__)

picture = Image.fromarray(np.zeros((40, 60, 3), np.uint8))
notes = Image.Exif()
notes[0x0112] = 6  # turned by a quarter
shapes, missing = {}, []
for name in ("x.jpg", "x.png", "x.tif"):
    picture.save(name, exif=notes)
    for flag, expected in (("IMREAD_UNCHANGED", (40, 60)), ("IMREAD_COLOR", (60, 40))):
        decoded = cv2.imdecode(np.fromfile(name, np.uint8), getattr(cv2, flag))
        shapes[name, flag] = decoded.shape[:2]
        missing += [name] if cv2.imread(name, getattr(cv2, flag)) is None else []
        print(f"{name} {flag}: {decoded.shape[:2]}, expected: {expected}")
print("read by imdecode, not by imread:", sorted(set(missing)), "expected: []")
turned = [name for (name, flag), shape in shapes.items() if flag[7:] == "UNCHANGED" and shape[0] == 60]
sys.exit(turned != ["x.tif"] or set(missing) != {"x.tif"})
PYTHON
