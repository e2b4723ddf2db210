"""Entry point of ``python -m occ_model``."""

from occ_model.cli import main

raise SystemExit(main())
