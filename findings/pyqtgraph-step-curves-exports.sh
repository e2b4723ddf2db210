#!/usr/bin/env bash
# A blinking LED is on or off, so its light over time is drawn by pyqtgraph's step curves. One would expect
# that an exporter writes the steps, or refuses. A curve whose steps begin at its points (stepMode "right" or
# "left") goes to Matplotlib as a line that slopes from point to point: chips become ramps. One whose steps
# have their own limits (stepMode "center") ends the export to Matplotlib and to HDF5 with a ValueError. CSV
# holds it; but from error bars it keeps the points alone, under the name "error", without any error.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pyqtgraph==0.14.0 PySide6-Essentials==6.10.2 \
    matplotlib==3.10.7 h5py==3.15.1
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import os
import sys

os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ["MPLBACKEND"] = "QtAgg"
import numpy as np
import pyqtgraph as pg
from PySide6 import __version__ as qt
from pyqtgraph import exporters
from pyqtgraph.exporters.Matplotlib import MatplotlibExporter

print("Python", sys.version.split()[0], "pyqtgraph", pg.__version__, "PySide6", qt)
application = pg.mkQApp()
chips = np.array([0.0, 1.0, 1.0, 0.0])
times = np.arange(5) * 100.0


def export_to_matplotlib(plot):
    MatplotlibExporter(plot.plotItem).export()
    return MatplotlibExporter.windows[-1].getFigure().axes[0].lines[0]


right = pg.PlotWidget()
right.plot(times[:4], chips, stepMode="right")
line = export_to_matplotlib(right)
print("stepMode right in Matplotlib: points", line.get_xydata().tolist(), "draw style", line.get_drawstyle())
assert line.get_drawstyle() == "default" and len(line.get_xydata()) == 4

centre = pg.PlotWidget()
centre.plot(times, chips, stepMode="center")
for name, export in (
    ("Matplotlib", lambda: export_to_matplotlib(centre)),
    ("HDF5", lambda: exporters.HDF5Exporter(centre.plotItem).export("chips.h5")),
):
    try:
        export()
    except ValueError as error:
        print(f"stepMode center, {name}: ValueError: {str(error)[:60]}...")
    else:
        sys.exit(f"{name} exported a step curve")

bars = pg.PlotWidget()
bars.addItem(pg.ErrorBarItem(x=times[:4], y=chips, height=np.full(4, 0.25)))
exporters.CSVExporter(bars.plotItem).export("bars.csv")
table = open("bars.csv").read().splitlines()
print("error bars in CSV:", table)
assert table[0] == "x0000_error,y0000_error"
assert not any(height in ",".join(table) for height in ("0.25", "0.125"))
PYTHON
