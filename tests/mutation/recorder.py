"""A plug-in of pytest that records which lines each test runs: ``pytest -p mutation.recorder``.

The environment names what to measure and where to store it. What a fixture of more than one test
runs is recorded under the fixture's name. A process that a test starts records under the name of
the test that is run as it starts.
"""

import json
import os
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest

FOLDER = "OCC_MUTATION_FOLDER"
PACKAGES = "OCC_MUTATION_PACKAGES"
FILE_SECONDS = "OCC_MUTATION_FILE_SECONDS"
CONTEXT = "OCC_MUTATION_CONTEXT"
PROCESS = "process of "

_PROCESSES = """\
[run]
data_file = {folder}/lines
parallel = true
source = {packages}
concurrency = multiprocessing, thread
context = ${{{context}}}
disable_warnings = no-data-collected, module-not-imported, module-not-measured, no-ctracer
core = ctrace
"""


class Recorder:
    """Switches the context of the measurement, and notes how long each test takes."""

    def __init__(self) -> None:
        import coverage

        self.folder = Path(os.environ[FOLDER])
        self.limit = float(os.environ[FILE_SECONDS])
        self.tests: dict[str, dict[str, Any]] = {}
        self.left_out: list[str] = []
        self._of_file: dict[str, float] = {}
        self._context = ""
        self._begun = 0.0
        packages = os.environ[PACKAGES]
        settings = self.folder / "processes.ini"
        settings.write_text(
            _PROCESSES.format(folder=self.folder, packages=packages, context=CONTEXT),
            encoding="utf-8",
        )
        self._coverage = coverage.Coverage(
            data_file=str(self.folder / "lines"),
            data_suffix=True,
            config_file=False,
            source=packages.split(","),
        )
        # The measurement by sys.monitoring knows no contexts.
        self._coverage.set_option("run:core", "ctrace")
        # Tests may reach no line of the packages: they import what others of their run have.
        self._coverage.set_option(
            "run:disable_warnings", ["module-not-measured", "no-data-collected"]
        )
        self._coverage.start()
        os.environ["COVERAGE_PROCESS_START"] = str(settings)
        self._switch("")

    def _switch(self, context: str) -> str:
        """Record under another name, and return that of before."""
        before, self._context = self._context, context
        self._coverage.switch_context(context)
        os.environ[CONTEXT] = PROCESS + context
        return before

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> bool | None:
        """Leave out a test whose file has had its time."""
        if self._of_file.get(_file(item.nodeid), 0.0) < self.limit:
            return None
        self.left_out.append(item.nodeid)
        return True

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_setup(self, item: pytest.Function) -> Generator[None]:
        """Record under the name of the test from here on."""
        shared = []
        for name, definitions in item._fixtureinfo.name2fixturedefs.items():
            shared += [f"{one.baseid}::{name}" for one in definitions if one.scope != "function"]
        self.tests[item.nodeid] = {"seconds": 0.0, "fixtures": shared}
        self._begun = _processor_seconds()
        self._switch(item.nodeid)
        return (yield)

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: Any) -> Generator[None, Any, Any]:
        """Record what several tests share under its own name."""
        if fixturedef.scope == "function":
            return (yield)
        before = self._switch(f"{fixturedef.baseid}::{fixturedef.argname}")
        try:
            return (yield)
        finally:
            self._switch(before)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        now = _processor_seconds()
        used, self._begun = now - self._begun, now
        self.tests[report.nodeid]["seconds"] += used
        file = _file(report.nodeid)
        self._of_file[file] = self._of_file.get(file, 0.0) + used

    def pytest_sessionfinish(self) -> None:
        self._coverage.stop()
        self._coverage.save()
        found = {"tests": self.tests, "left out": self.left_out}
        (self.folder / "tests.json").write_text(json.dumps(found), encoding="utf-8")


def _processor_seconds() -> float:
    """Return what this process and its ended children have computed: others take none of it."""
    return sum(os.times()[:4])


def _file(test: str) -> str:
    return test.partition("::")[0]


def pytest_configure(config: pytest.Config) -> None:
    config.pluginmanager.register(Recorder())
