#!/usr/bin/env bash
# An AVI file has no times: it numbers its frames in the order of decoding. Where H.264 keeps frames for
# later ones to refer to, that is not the order in which they are shown. One would expect that decoded
# frames, which come as they are shown, have times that rise, as for MPEG-4 in AVI. Those of H.264 keep the
# times of decoding, and lead back and forth.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet av==18.1.0 numpy==2.3.5
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import av

print("Python", sys.version.split()[0], "PyAV", av.__version__, "FFmpeg", av.ffmpeg_version_info)


def times_of(codec):
    with av.open("film.avi", "w") as film:
        stream = film.add_stream(codec, 25, {"bf": "2"})
        stream.width, stream.height, stream.pix_fmt = 64, 48, "yuv420p"
        for number in range(24):
            frame = av.VideoFrame(64, 48, "yuv420p")
            for plane in frame.planes:
                plane.update(bytes([16 + 8 * number]) * plane.buffer_size)
            frame.pts = number
            film.mux(stream.encode(frame))
        film.mux(stream.encode(None))
    with av.open("film.avi") as film:
        decoded = [(frame.pts, bytes(frame.planes[0])[0]) for frame in film.decode(video=0)]
    levels = [level for _, level in decoded]
    assert levels == sorted(levels)  # they come in the order in which they are shown
    return [time for time, _ in decoded]


mpeg4, h264 = times_of("mpeg4"), times_of("libx264")
print("MPEG-4:", mpeg4[:9], "expected: rising")
print("H.264: ", h264[:9], "expected: rising")
sys.exit(mpeg4 != sorted(mpeg4) or h264 == sorted(h264))
PYTHON
