"""Environment, fixtures and hooks of all tests."""

import builtins
import gc
import os
import shutil
import sys
from collections.abc import Generator
from importlib.util import find_spec
from pathlib import Path
from tempfile import mkdtemp
from typing import Protocol

# Before Qt is imported anywhere: no test opens a window on a real screen.
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

# As in the programs; if each process of the tests had a thread for each core, all would wait.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# Compiled modules are kept even if Python is told not to keep them: tests start hundreds of
# processes, each of which would spend more than half of its start compiling.
if sys.dont_write_bytecode:
    sys.dont_write_bytecode = False
    sys.pycache_prefix = str(Path(__file__).parents[1] / ".pytest_cache" / "bytecode")
    os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# Tests neither read nor change the presets and lessons of the user who runs them.
os.environ["OCC_PRESETS"] = str(Path(__file__).with_name("no-presets"))
os.environ["OCC_LESSONS"] = str(Path(__file__).with_name("no-lessons"))

# Nor the stored session; what a window stores is deleted after the tests.
os.environ["OCC_STATE"] = mkdtemp(prefix="occ-tests-")

import pytest
from amount import WHOLE_VARIABLE, amount
from hard_cases import laws
from hypothesis import settings

_FONTS = """\
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
"""Only the fonts of matplotlib, since each system has others."""


def use_only_these_fonts(folder: Path) -> None:
    """Let Qt find no other fonts, in this process and those that it starts.

    ``folder`` keeps the configuration, and what fontconfig makes of it.
    """
    matplotlib = find_spec("matplotlib")
    assert matplotlib is not None
    assert matplotlib.origin is not None
    fonts = Path(matplotlib.origin).parent / "mpl-data" / "fonts" / "ttf"
    configuration = folder / "fonts.conf"
    text = _FONTS.format(fonts=fonts, cache=folder / "fonts")
    configuration.write_text(text, encoding="utf-8")
    os.environ["FONTCONFIG_FILE"] = str(configuration)


use_only_these_fonts(Path(os.environ["OCC_STATE"]))

NEW_EXAMPLES = "OCC_NEW_EXAMPLES" in os.environ
"""Whether Hypothesis draws new examples, as many as it usually does; else always the same ones."""

_PHOTOS = Path(__file__).parents[2] / "shared" / "photos"

_IMPORT = builtins.__import__
"""The function of imports before Qt replaces it."""

_WORKER = int(os.environ.get("PYTEST_XDIST_WORKER", "gw-1").removeprefix("gw"))
"""The number of this process of pytest-xdist; -1 if the tests run without it."""


def pytest_unconfigure() -> None:
    """Remove what the windows of the tests have stored."""
    shutil.rmtree(os.environ["OCC_STATE"], ignore_errors=True)


@pytest.fixture(scope="session")
def photos() -> Path:
    """The folder of the real photographs; outside CI, tests that need it are skipped without it."""
    if not _PHOTOS.is_dir() and not os.environ.get("CI"):
        pytest.skip("the real photographs are not here")
    assert _PHOTOS.is_dir(), "CI needs the real photographs beside the project"
    return _PHOTOS


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options of the tests themselves."""
    parser.addoption(
        "--whole", action="store_true",
        help="run the tests marked `whole` too, and all cases of which the others try a sample",
    )  # fmt: skip
    parser.addoption(
        "--renew-snapshots", action="store_true",
        help="store the pictures of the panes anew in place of comparing them",
    )  # fmt: skip


@pytest.hookimpl(trylast=True)  # when pytest-qt has imported Qt
def pytest_configure(config: pytest.Config) -> None:
    """Set how many cases are tried, before the modules with tests are imported."""
    # PySide's function reads the source of each imported module; as the program does, restore this.
    builtins.__import__ = _IMPORT
    if config.getoption("--whole"):
        os.environ[WHOLE_VARIABLE] = "1"
    examples = 100 if NEW_EXAMPLES else amount(everyday=30, whole=40)
    settings.register_profile(
        "occ", deadline=None, print_blob=True, derandomize=not NEW_EXAMPLES, max_examples=examples
    )
    settings.load_profile("occ")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect no garbage among thousands of tests and modules, which stay until the end."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()
        gc.freeze()


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Let every second process of pytest-xdist begin with the last file.

    To rewrite the asserts of all files takes longer than to import them, and is done once: two
    processes that meet in the middle do half of it each.
    """
    report = yield
    if _WORKER % 2 and report.passed and isinstance(collector, pytest.Directory):
        report.result.reverse()
    return report


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Run tests marked ``first`` first, and deselect those that run with ``--whole`` only."""
    if _WORKER >= 0:
        items.sort(key=lambda item: item.path.parts)  # alike in all processes
    items.sort(key=lambda item: item.get_closest_marker("first") is None)
    if config.getoption("--whole"):
        return
    left_out = [item for item in items if item.get_closest_marker("whole")]
    items[:] = [item for item in items if not item.get_closest_marker("whole")]
    config.hook.pytest_deselected(items=left_out)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Make an unexpected skip an error: a test that does not run proves nothing."""
    report = yield
    if (
        report.skipped
        and not any(map(item.get_closest_marker, ("photos", "compilers")))
        and not hasattr(report, "wasxfail")
    ):
        report.outcome = "failed"
        report.longrepr = (
            f"{item.nodeid} was skipped, which only tests of photos and compilers may be"
        )
    return report


class Worker(Protocol):
    """A process of pytest-xdist, as the process that collects the results sees it."""

    workeroutput: dict[str, list[laws.Row]]


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Let a process of pytest-xdist send what it found of the hard cases."""
    output = getattr(session.config, "workeroutput", None)
    if output is not None:
        output["hard_cases"] = laws.rows()


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Worker) -> None:
    """Add what a process of pytest-xdist found; one that died has sent nothing."""
    for row in getattr(node, "workeroutput", {}).get("hard_cases", ()):
        laws.merge(*row)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print the largest error of each law of the hard cases."""
    if laws.FOUND:
        total = sum(found.cases for found in laws.FOUND.values())
        terminalreporter.write_sep("=", f"numerical health, {total:,} cases")
        for line in laws.table():
            terminalreporter.write_line(line)
