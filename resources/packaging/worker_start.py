"""Start of worker processes in the bundle, which run the same program with other arguments."""

import sys
from multiprocessing import freeze_support


def become_worker() -> None:
    """Run as a worker and do not return, if this process was started as one."""
    from occ_model.video.file.decoder_main import DECODER_OPTION, main

    if sys.argv[1:] == [DECODER_OPTION]:
        main()
    # PyInstaller recognizes such a start by Python's own options before -c. The model's option that
    # silences a warning of multiprocessing is not among them, and has no effect in a bundle.
    if "-c" in sys.argv:
        sys.argv[1:] = [word for word in sys.argv[1:] if not word.startswith("-Wignore")]
    freeze_support()
