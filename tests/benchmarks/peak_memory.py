"""Prints the most bytes that a complete simulation needs, in bytes of its picture (on Linux)."""

import sys
from pathlib import Path

import occ_model as occ


def peak() -> int:
    """Give the most bytes that this process has had in memory."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) * 1024
    raise SystemExit("This system does not tell a process's peak memory.")


scene = occ.load_preset(sys.argv[1])
occ.render(scene.replace(rows=200), tolerance=0.0)  # all that is loaded once is loaded now
before = peak()
image = occ.render(scene, tolerance=0.0).image
print((peak() - before) / image.nbytes)
