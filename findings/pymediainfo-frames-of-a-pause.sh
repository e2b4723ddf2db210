#!/usr/bin/env bash
# A phone's film often begins with sound, and its pictures some tens of milliseconds later. MP4 says so by an edit
# list, Matroska by the first frame's time. The number of frames, which gives a lamp's phase at the end of a film,
# stands in MP4 itself. One would expect that MediaInfo's frame_count is that number, and the same of both
# files. In MP4 the pause before the first frame counts, as if frames were shown in it: 63 frames where 60
# are, with a pause of 0.1 s, in a duration of 2.1 s. The number that the file states is called source_frame_count.
# In Matroska frame_count is 60, and the pause is the delay.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pymediainfo==7.0.1 av==18.1.0
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from fractions import Fraction
from importlib.metadata import version

import av
from pymediainfo import MediaInfo

print("Python", sys.version.split()[0], "pymediainfo", version("pymediainfo"), "PyAV", av.__version__)
TICKS = Fraction(1, 90000)


def write(name, pause):
    with av.open(name, "w") as film:
        stream = film.add_stream("libx264", 30)
        stream.width, stream.height, stream.pix_fmt = 64, 48, "yuv420p"
        stream.time_base = stream.codec_context.time_base = TICKS
        for number in range(60):
            frame = av.VideoFrame(64, 48, "yuv420p")
            frame.pts, frame.time_base = round((pause + Fraction(number, 30)) / TICKS), TICKS
            film.mux(stream.encode(frame))
        film.mux(stream.encode(None))


counts = {}
for name in ("lamp.mp4", "lamp.mkv"):
    for pause in (Fraction(0), Fraction(1, 10), Fraction(1, 2)):
        write(name, pause)
        with av.open(name) as film:
            decoded = sum(1 for _ in film.decode(video=0))
        track = MediaInfo.parse(name).video_tracks[0]
        counts[name, float(pause)] = (int(track.frame_count), int(track.source_frame_count or 0))
        print(f"{name}, pause of {float(pause)} s: {decoded} frames decoded, frame_count {track.frame_count},", end=" ")
        print(f"source_frame_count {track.source_frame_count}, duration {track.duration} ms, delay {track.delay}")
        assert decoded == 60
assert counts["lamp.mp4", 0.0][0] == 60 and counts["lamp.mp4", 0.1] == (63, 60) and counts["lamp.mp4", 0.5] == (75, 60)
assert {counts["lamp.mkv", pause][0] for pause in (0.0, 0.1, 0.5)} == {60}
PYTHON
