"""Fonts of the tests: those that matplotlib brings along, as each system has others."""

import os
from importlib.util import find_spec
from pathlib import Path

_CONFIGURATION = """\
<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "urn:fontconfig:fonts.dtd">
<fontconfig>
  <dir>{fonts}</dir>
  <cachedir>{cache}</cachedir>
  <selectfont>
    <rejectfont><glob>*</glob></rejectfont>
    <acceptfont><glob>*/DejaVuSans*</glob></acceptfont>
  </selectfont>
  <alias><family>monospace</family><prefer><family>DejaVu Sans Mono</family></prefer></alias>
  <alias><family>sans-serif</family><prefer><family>DejaVu Sans</family></prefer></alias>
</fontconfig>
"""


def font_folder() -> Path:
    """Find the folder of DejaVu Sans."""
    spec = find_spec("matplotlib")
    assert spec is not None
    assert spec.origin is not None
    return Path(spec.origin).parent / "mpl-data" / "fonts" / "ttf"


def use_only_these(folder: Path) -> None:
    """Let Qt find no other fonts, in this process and those that it starts.

    ``folder`` keeps the configuration, and what fontconfig makes of it.
    """
    configuration = folder / "fonts.conf"
    text = _CONFIGURATION.format(fonts=font_folder(), cache=folder / "fonts")
    configuration.write_text(text, encoding="utf-8")
    os.environ["FONTCONFIG_FILE"] = str(configuration)
