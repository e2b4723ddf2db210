#!/usr/bin/env bash
# A pyqtgraph plot with a logarithmic frequency axis can be exported as CSV, as HDF5 and to Matplotlib. One
# would expect the same numbers in all three. CSV holds the frequencies in Hz. HDF5 and Matplotlib hold
# their common logarithms, without a word that says so, and Matplotlib's axis is linear.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet PySide6-Essentials==6.10.2 pyqtgraph==0.14.0 numpy==2.3.5 \
    matplotlib==3.11.2 h5py==3.15.1
cd "$folder"
QT_QPA_PLATFORM=offscreen "$folder/venv/bin/python" - <<'PYTHON'
import sys

import h5py
import matplotlib
import pyqtgraph
from pyqtgraph.exporters import CSVExporter, HDF5Exporter, MatplotlibExporter

print("Python", sys.version.split()[0], "pyqtgraph", pyqtgraph.__version__)
print("h5py", h5py.__version__, "Matplotlib", matplotlib.__version__)
application = pyqtgraph.mkQApp()
widget = pyqtgraph.PlotWidget()
plot = widget.getPlotItem()
plot.plot([1000.0, 10000.0], [1.0, 2.0], name="profile")
plot.setLogMode(x=True, y=False)
widget.show()
application.processEvents()

CSVExporter(plot).export("plot.csv")
with open("plot.csv") as file:
    csv = [float(line.split(",")[0]) for line in file.readlines()[1:]]
HDF5Exporter(plot).export("plot.h5")
with h5py.File("plot.h5") as file:
    hdf5 = file["Export"][0].tolist()
MatplotlibExporter(plot).export()
axes = MatplotlibExporter.windows[-1].getFigure().axes[0]
lines = axes.lines[0].get_xdata().tolist()
print("CSV:       ", csv)
print("HDF5:      ", hdf5, "expected: [1000.0, 10000.0]")
print("Matplotlib:", lines, axes.get_xscale(), "expected: [1000.0, 10000.0] log")
assert csv == [1000.0, 10000.0]
assert hdf5 == [3.0, 4.0]
assert (lines, axes.get_xscale()) == ([3.0, 4.0], "linear")
PYTHON
