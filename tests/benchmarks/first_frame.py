"""Start the application, wait until its first frame is painted, and end at once."""

import os
import sys

import occ_model as occ
from occ_gui.app import start, wait_until_shown


def main() -> None:
    """End once the picture pane has painted a frame."""
    _, application = start(occ.load_preset("phone-68us"), sys.argv[:1])
    application.window.show()
    wait_until_shown(application)
    application.window.grab()
    os._exit(0)  # what closing takes is no part of the start


if __name__ == "__main__":
    main()
