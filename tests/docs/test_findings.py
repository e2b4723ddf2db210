"""The scripts in ``findings`` have the form that the developers' page states; none is run here."""

import os
import re
import subprocess
from pathlib import Path

from documents import ROOT, text_of
from each_case import each_case

SCRIPTS = sorted((ROOT / "findings").iterdir())


@each_case(SCRIPTS)
def test_a_finding_is_a_script_of_the_form_that_is_described(script: Path) -> None:
    text = text_of(script)
    assert re.fullmatch(r"[a-z0-9][a-z0-9-]*\.sh", script.name)
    assert os.access(script, os.X_OK)
    assert re.match(r"#!/usr/bin/env bash\n# [A-Z].*\n# ", text), "a comment at the head"
    for needed in ("set -euo pipefail", "mktemp -d", "trap ", "-m venv"):
        assert needed in text
    assert re.search(r"[\w\]]==\d", text), "packages of stated versions"
    assert "://" not in text
    subprocess.run(["bash", "-n", script], check=True)
