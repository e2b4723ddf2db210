#!/usr/bin/env bash
# A phone's front camera may write a film that is mirrored, and a matrix in its track that mirrors it back.
# PyAV sums the matrix up as frame.rotation. One would expect 0 for a matrix that only exchanges left and
# right, or an error. It is -180, so who turns the frames by it has them upside down, and still mirrored.
# The matrix itself is in frame.side_data, a Mapping: its values() should give it, and raises KeyError.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet av==18.1.0 numpy==2.3.5
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import av
import numpy as np
from av.sidedata.sidedata import Type

print("Python", sys.version.split()[0], "PyAV", av.__version__, "FFmpeg", av.ffmpeg_version_info)

ONE = 1 << 16
MIRROR = [-ONE, 0, 0, 0, ONE, 0, 0, 0, 1 << 30]
with av.open("mirrored.mp4", "w") as film:
    stream = film.add_stream("mpeg4", 30)
    stream.width, stream.height, stream.pix_fmt = 64, 48, "yuv420p"
    stream.set_display_matrix(MIRROR)
    frame = av.VideoFrame(64, 48, "yuv420p")
    frame.pts = 0
    film.mux(stream.encode(frame))
    film.mux(stream.encode(None))
with av.open("mirrored.mp4") as film:
    frame = next(film.decode(video=0))
matrix = np.frombuffer(frame.side_data[Type.DISPLAYMATRIX], np.int32)
print("matrix", (matrix[[0, 1, 3, 4]] / ONE).tolist(), "rotation", frame.rotation, "expected: 0")
try:
    values = list(frame.side_data.values())
except KeyError as error:
    values = f"KeyError: {error}"
print("values of the side data:", values, "expected: a list of", len(frame.side_data))
as_seen = matrix.tolist() == MIRROR and frame.rotation == -180 and str(values).startswith("KeyError")
sys.exit(not as_seen)
PYTHON
