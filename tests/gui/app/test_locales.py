"""The window starts in every locale, and its numbers are the same in each."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[3]

CHARACTERS = """\
<code_set_name> UTF-8
<comment_char> %
<escape_char> /
<mb_cur_min> 1
<mb_cur_max> 6
CHARMAP
<U0000>..<U007F> /x00 ASCII
<U0130> /xc4/xb0 LATIN CAPITAL LETTER I WITH DOT ABOVE
<U0131> /xc4/xb1 LATIN SMALL LETTER DOTLESS I
END CHARMAP
"""

# What sets Turkish, Azerbaijani, Kurdish and Crimean Tatar apart, and a comma in numbers. Written
# out, because the sources of the real locales are in a package that few machines have.
RULES = """\
comment_char %
escape_char /
LC_CTYPE
upper <U0041>..<U005A>;<U0130>
lower <U0061>..<U007A>;<U0131>
digit <U0030>..<U0039>
space <U0009>..<U000D>;<U0020>
cntrl <U0000>..<U001F>;<U007F>
toupper {upper};(<U0131>,<U0049>)
END LC_CTYPE
LC_NUMERIC
decimal_point "<U002C>"
thousands_sep "<U002E>"
grouping 3;3
END LC_NUMERIC
"""

START = """
import ctypes
import locale
from PySide6.QtCore import QTimer
import occ_gui.app.command_line as app

begin = app.start

def start(*arguments):
    qt, application = begin(*arguments)
    def look():
        place = application.view("photo").placement.column
        print("i:", hex(ctypes.CDLL(None).towupper(ord("i"))))
        print("point:", locale.localeconv()["decimal_point"])
        print("code:", application.controls.code.number.text())
        print("place:", place.textFromValue(1234.5), place.valueFromText("2.5"))
        application.window.close()
    QTimer.singleShot(0, look)
    return qt, application

app.start = start
raise SystemExit(app.main(["--fresh", "--set", "rows=100", "--set", "code=718"]))
"""


@pytest.fixture(scope="module")
def locales(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build a locale of the dotted capital I and the decimal comma."""
    folder = tmp_path_factory.mktemp("locales")
    letters = (chr(code) for code in range(ord("a"), ord("z") + 1))
    upper = {letter: 0x130 if letter == "i" else ord(letter.upper()) for letter in letters}
    pairs = ";".join(f"(<U{ord(low):04X}>,<U{high:04X}>)" for low, high in upper.items())
    (folder / "characters").write_text(CHARACTERS, encoding="ascii")
    (folder / "rules").write_text(RULES.format(upper=pairs), encoding="ascii")
    # What is left out warns, and without -c that is the end.
    subprocess.run(
        ["localedef", "-c", "-i", "rules", "-f", "characters", "./tr_TR.UTF-8"],
        cwd=folder, capture_output=True, check=False,
    )  # fmt: skip
    assert (folder / "tr_TR.UTF-8" / "LC_NUMERIC").is_file()
    return folder


# Qt takes the way of writing numbers from the name alone, whether there is such a locale or not.
@pytest.mark.parametrize(
    ("numbers", "point"),
    [
        ("tr_TR.UTF-8", ","),
        pytest.param("ar_EG.UTF-8", ".", marks=pytest.mark.whole),
        pytest.param("C", ".", marks=pytest.mark.whole),
        pytest.param("fa_IR.UTF-8", ".", marks=pytest.mark.whole),
    ],
)
def test_the_window_writes_numbers_alike_in_any_locale(
    locales: Path, tmp_path: Path, numbers: str, point: str
) -> None:
    own = {name: value for name, value in os.environ.items() if not name.startswith(("LC_", "LAN"))}
    environment = {
        **own, "QT_QPA_PLATFORM": "offscreen", "OCC_STATE": str(tmp_path / "state"),
        "LOCPATH": str(locales), "LC_CTYPE": "tr_TR.UTF-8", "LC_NUMERIC": numbers,
    }  # fmt: skip
    window = subprocess.run(
        [sys.executable, "-c", START],
        cwd=PROJECT, env=environment, capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert (window.returncode, window.stderr) == (0, "")
    assert window.stdout.splitlines() == [
        "i: 0x130", f"point: {point}", "code: 718", "place: 1234.50 2.5",
    ]  # fmt: skip


def test_no_property_of_qt_is_set_by_a_keyword_starting_with_i() -> None:
    # PySide finds the setter by the capital of its first letter, which depends on the locale.
    given = [
        f"{path.name}: {call}"
        for path in (PROJECT / "occ_gui").rglob("*.py")
        for call in re.findall(r"\bQ[A-Z]\w+\([^()]*\bi\w*=[^()]*\)", path.read_text("utf-8"))
    ]
    assert given == []
