"""Start the application, wait until its first frame is painted, and end at once."""

import gc
import os
import sys


def main() -> None:
    """End once the picture pane has painted a frame; what it says is read a little later."""
    gc.disable()  # as the program's entry does
    import occ_model as occ
    from occ_gui.app.command_line import start
    from occ_gui.core.workspace import Workspace

    qt, application = start(Workspace(occ.load_preset("phone-68us")), sys.argv[:1])
    # Only now, as in the program: PySide reads the source of what is imported after it.
    from PySide6.QtCore import QEventLoop

    pictures: list[object] = []
    application.simulation.picture_ready.connect(pictures.append)
    application.window.show()
    while not pictures:
        qt.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
    qt.processEvents()
    os._exit(0)  # what closing takes is no part of the start


if __name__ == "__main__":
    main()
