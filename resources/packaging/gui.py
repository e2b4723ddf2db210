"""Start of the bundled application."""

from worker_start import become_worker

if __name__ == "__main__":
    become_worker()
    from occ_gui.__main__ import main

    raise SystemExit(main())
