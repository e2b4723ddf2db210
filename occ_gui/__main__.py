"""``python -m occ_gui``."""

from occ_gui.app import main

raise SystemExit(main())
