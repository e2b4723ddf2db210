"""Start the application, wait until its first frame is painted, and end."""

import sys

import occ_model as occ
from occ_gui.app import start, wait_until_shown


def main() -> None:
    """End once the picture pane has painted a frame."""
    _, application = start(occ.load_preset("phone-68us"), sys.argv[:1])
    application.window.show()
    wait_until_shown(application)
    application.window.grab()
    application.window.close()


if __name__ == "__main__":
    main()
