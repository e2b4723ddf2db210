"""Entry point of ``occ-gui`` and ``python -m occ_gui``."""

import gc
from collections.abc import Callable

from occ_model.program import run_program


def main() -> int:
    return run_program("occ-gui", _command, is_process=True, is_window=True)


def _command() -> Callable[[], int]:
    gc.disable()  # imported modules stay; the window collects garbage on its own thread
    # Imported here, where Ctrl-C is handled already: it imports much of the model.
    from occ_gui.app.command_line import read_command_line

    return read_command_line(None)


if __name__ == "__main__":
    raise SystemExit(main())
