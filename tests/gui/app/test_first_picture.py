"""The first picture waits for no pane that is not seen, nor for what such a pane imports."""

import os
import subprocess
import sys

START = """
import sys
import occ_model as occ
from occ_gui.app.command_line import start
from occ_gui.core.workspace import Workspace

qt, application = start(Workspace(occ.load_preset("phone-68us").replace(rows=200)), ["occ-gui"])
pictures = []
application.simulation.picture_ready.connect(pictures.append)
application.window.show()
while not pictures:
    qt.processEvents()
qt.processEvents()
late = ("pyqtgraph", "matplotlib", "scipy", "occ_gui.photo.photo_view", "occ_gui.lessons.pane")
print([name for name in late if name in sys.modules])
print([name for name in application.shell.help_pages if application.shell.made_pane(name)])
application.window.close()
"""


def test_the_first_picture_is_there_before_any_pane_is_made() -> None:
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    done = subprocess.run(
        [sys.executable, "-c", START], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.split("\n")[:2] == ["[]", "[]"]
