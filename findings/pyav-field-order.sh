#!/usr/bin/env bash
# An interlaced film has two fields a frame, and its file says which one is shown first. Where FFmpeg's program
# writes one whose upper field is the first to Matroska, it stores the value 9, that of such fields whose
# lines are stored in turn (RFC 9559). PyAV gives it as 4, FFmpeg's AV_FIELD_TB, which FFmpeg's header explains
# as "Top coded first, bottom displayed first". One would expect AV_FIELD_TT, 2, as of the same film in MP4:
# who believes the explanation exchanges the fields.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet av==18.1.0 imageio-ffmpeg==0.6.0
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import subprocess
import sys
from pathlib import Path

import av
import imageio_ffmpeg

print("Python", sys.version.split()[0], "PyAV", av.__version__, "FFmpeg", av.ffmpeg_version_info)

UPPER_FIRST = 2  # AV_FIELD_TT
pictures = bytes(64 * 48 * 3 // 2) * 4
form = "-f rawvideo -pix_fmt yuv420p -s 64x48 -r 30 -i - -vf setfield=tff"
found = {}
for ending in ("mp4", "mkv"):
    command = f"{form} -c:v libx264 -flags +ildct+ilme -x264opts tff=1 film.{ending}"
    ffmpeg = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "error", *command.split()]
    subprocess.run(ffmpeg, input=pictures, check=True)
    with av.open(f"film.{ending}") as film:
        assert next(film.decode(video=0)).interlaced_frame
        found[ending] = film.streams.video[0].codec_context.field_order
    print(f"{ending}: {found[ending]}, expected: {UPPER_FIRST}")
stored = Path("film.mkv").read_bytes()
print("Matroska's own value:", stored[stored.index(b"\x9a\x81\x01\x9d\x81") + 5])
sys.exit(found != {"mp4": UPPER_FIRST, "mkv": 4})
PYTHON
