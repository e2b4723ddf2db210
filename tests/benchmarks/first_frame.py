"""Start the application, wait until its first frame is painted, and end."""

import sys

import occ_model as occ
from occ_gui.app import start


def main() -> None:
    """End once the picture pane has painted a frame."""
    qt, application = start(occ.load_preset("phone-68us"), sys.argv[:1])
    application.window.show()
    while not application.is_idle:
        qt.processEvents()
    application.window.grab()
    application.window.close()


if __name__ == "__main__":
    main()
