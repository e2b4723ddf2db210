"""Prints, after the tests, how wrong each law was found at worst."""

import pytest

from hard_cases import laws


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if laws.FOUND:
        total = sum(found.cases for found in laws.FOUND.values())
        terminalreporter.write_sep("=", f"numerical health, {total:,} cases")
        for line in laws.table():
            terminalreporter.write_line(line)
