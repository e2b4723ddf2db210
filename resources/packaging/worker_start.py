"""Start of worker processes in the bundle: each is the program once more, with other arguments."""

import sys
from multiprocessing import freeze_support


def become_worker() -> None:
    """Turn to a worker's task and never return, where this process was started as a worker."""
    from occ_model.video.file.decoder_main import DECODER_OPTION, main

    if sys.argv[1:] == [DECODER_OPTION]:
        main()
    # PyInstaller knows such a start by Python's own options before -c. The one by which the model
    # silences a warning of multiprocessing is not among them, and means nothing in a bundle.
    if "-c" in sys.argv:
        sys.argv[1:] = [word for word in sys.argv[1:] if not word.startswith("-Wignore")]
    freeze_support()
