#!/usr/bin/env bash
# A part of a raw picture, such as the lines of a lamp's panel, is a view of an array: its lines lie further
# apart than they are long. OpenCV takes such arrays everywhere, and one would expect that demosaicing a view
# gives what demosaicing a copy of it gives. So it does, bilinear and VNG. The edge-aware method reads and
# writes as if the lines followed each other without a gap: nearly every pixel is wrong, also those that
# the mosaic has, and nothing says so. A result that is written into a view given as dst is as wrong.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet opencv-python-headless==5.0.0.93 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import cv2
import numpy as np

print("Python", sys.version.split()[0], "OpenCV", cv2.__version__)

view = np.random.default_rng(0).integers(0, 256, (60, 80), dtype=np.uint8)[:, :40]
unlike = []
for method in ("", "_VNG", "_EA"):
    code = getattr(cv2, f"COLOR_BayerRGGB2RGB{method}")
    expected = cv2.demosaicing(view.copy(), code)
    given = np.zeros((60, 100, 3), np.uint8)[:, :40]
    cv2.demosaicing(view.copy(), code, dst=given)
    for what, found in (("of a view", cv2.demosaicing(view, code)), ("into a view", given)):
        wrong = np.mean((found != expected).any(axis=2))
        kept = np.mean(found[2:-2:2, 2:-2:2, 0] == view[2:-2:2, 2:-2:2])
        print(f"{method[1:] or 'bilinear'} {what}: {wrong:.0%} of the pixels wrong, expected: 0%; "
              f"{kept:.0%} of the red photosites kept, expected: 100%")
        unlike += [(method, what)] if wrong > 0.5 else []
sys.exit(unlike != [("_EA", "of a view"), ("_EA", "into a view")])
PYTHON
