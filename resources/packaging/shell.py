"""Start of the bundled command line."""

from worker_start import become_worker

if __name__ == "__main__":
    become_worker()
    from occ_model.cli import main

    raise SystemExit(main())
