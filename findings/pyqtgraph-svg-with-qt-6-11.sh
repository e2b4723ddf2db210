#!/usr/bin/env bash
# A plot becomes SVG in pyqtgraph by letting Qt draw it; pyqtgraph then rewrites the paths that Qt drew. Its
# newest release works with any Qt 6 by its own statement. One would expect that each of them can export a
# curve of three points. With Qt 6.10 it is written. With Qt 6.11, which spells its paths in another way,
# the export of every plot ends with a ValueError: a program that offers it has to keep Qt below 6.11, or
# write SVG otherwise.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > export.py <<'PYTHON'
import pyqtgraph
import PySide6
from pyqtgraph.exporters import SVGExporter

application = pyqtgraph.mkQApp()
plot = pyqtgraph.PlotWidget()
plot.plot([1, 2, 3], [1, 4, 9])
plot.show()
application.processEvents()
try:
    SVGExporter(plot.getPlotItem()).export("plot.svg")
    print("PySide6", PySide6.__version__, "pyqtgraph", pyqtgraph.__version__, "written")
except ValueError as error:
    print("PySide6", PySide6.__version__, "pyqtgraph", pyqtgraph.__version__, "ValueError:", error)
PYTHON

export QT_QPA_PLATFORM=offscreen
for version in 6.10.2 6.11.3; do
    python3 -m venv "$folder/$version"
    "$folder/$version/bin/pip" install --quiet "PySide6-Essentials==$version" pyqtgraph==0.14.0 numpy==2.3.5
    "$folder/$version/bin/python" export.py 2> errors | tee -a seen
done
grep -q "PySide6 6.10.2 .* written" seen
grep -q "PySide6 6.11.3 .* ValueError: not enough values to unpack" seen
echo "As found: expected is 'written' twice."
