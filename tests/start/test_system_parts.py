"""The laws of `resources/start.py` on what the system must have."""

import importlib.util
import os
import shutil
import subprocess
import sys
from types import ModuleType, SimpleNamespace

import pytest

from occ_gui.app import system_libraries

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="checks the set-up of Linux")


def provide_programs(monkeypatch: pytest.MonkeyPatch, *programs: str) -> None:
    """Let just these programs be found."""
    monkeypatch.setattr(shutil, "which", lambda name: name if name in programs else None)


def set_missing(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, *answers: dict[str, str]
) -> None:
    """Let the system lack these parts, one answer for each time it is asked."""
    queue = list(answers)
    monkeypatch.setattr(start, "missing_parts", lambda platform, making_venv: queue.pop(0))


@pytest.mark.parametrize(
    ("platform", "found_missing"),
    [
        ("offscreen", ["libegl1"]),
        ("", ["libegl1"]),
        ("xcb", ["libegl1", "libxcb-icccm4"]),
        ("wayland", ["libegl1", "libwayland-cursor0"]),
    ],
)
def test_only_libraries_of_the_platform_in_use_are_asked_for(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, platform: str, found_missing: list[str]
) -> None:
    absent = {"libEGL.so.1", "libxcb-icccm.so.4", "libwayland-cursor.so.0"}
    monkeypatch.setattr(system_libraries, "can_load", lambda library: library not in absent)
    monkeypatch.setattr(start, "has_font", lambda: True)
    assert list(start.missing_parts(platform, False).values()) == found_missing


def test_a_library_counts_as_there_when_the_linker_loads_it() -> None:
    assert system_libraries.can_load("libc.so.6")
    assert not system_libraries.can_load("libnothing-of-this-name.so.1")


@pytest.mark.parametrize("making_venv", [True, False])
def test_only_making_a_venv_needs_pythons_venv_package(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, making_venv: bool
) -> None:
    monkeypatch.setattr(system_libraries, "can_load", lambda library: True)
    monkeypatch.setattr(start, "has_font", lambda: True)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    packages = list(start.missing_parts("", making_venv).values())
    assert packages == ([f"python{start.RUNNING}-venv"] if making_venv else [])


@pytest.mark.parametrize(
    ("user", "programs", "sudo_code", "terminal", "prefix"),
    [
        (0, [], 1, False, []),
        (0, ["sudo"], 1, True, []),
        (1000, [], 1, True, None),
        (1000, ["sudo"], 0, False, ["sudo"]),
        (1000, ["sudo"], 1, True, ["sudo"]),
        (1000, ["sudo"], 1, False, None),
    ],
)
def test_sudo_is_used_without_a_question_or_with_a_terminal(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    user: int,
    programs: list[str],
    sudo_code: int,
    terminal: bool,
    prefix: list[str] | None,
) -> None:
    provide_programs(monkeypatch, *programs)
    monkeypatch.setattr(os, "geteuid", lambda: user)
    monkeypatch.setattr(os, "isatty", lambda descriptor: terminal)
    answer = SimpleNamespace(returncode=sudo_code)
    monkeypatch.setattr(subprocess, "run", lambda command, **options: answer)
    assert start.root_prefix() == prefix


def test_a_complete_system_is_left_alone(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, visible: list[str]
) -> None:
    set_missing(start, monkeypatch, {})
    start.provide_system_parts("xcb", making_venv=True)
    assert visible == []


@pytest.mark.parametrize(("user", "prefix"), [(0, ""), (1000, "sudo ")])
def test_only_missing_packages_are_installed_after_a_fresh_list(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, visible: list[str], user: int, prefix: str
) -> None:
    provide_programs(monkeypatch, "apt-get", "sudo")
    monkeypatch.setattr(start, "root_prefix", prefix.split)
    set_missing(start, monkeypatch, {"libEGL.so.1": "libegl1", "a font": "fonts-dejavu-core"}, {})
    start.provide_system_parts("offscreen", making_venv=False)
    apt = f"{prefix}env DEBIAN_FRONTEND=noninteractive apt-get"
    install = "install -y --no-install-recommends libegl1 fonts-dejavu-core"
    assert visible == [f"{apt} update", f"{apt} {install}"]


@pytest.mark.parametrize(("programs", "sudo"), [(["apt-get"], ""), (["apt-get", "sudo"], "sudo ")])
def test_without_rights_the_line_to_run_by_hand_is_named(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    visible: list[str],
    programs: list[str],
    sudo: str,
) -> None:
    provide_programs(monkeypatch, *programs)
    monkeypatch.setattr(start, "root_prefix", lambda: None)
    set_missing(start, monkeypatch, {"libEGL.so.1": "libegl1"})
    with pytest.raises(start.SetUpError) as problem:
        start.provide_system_parts("offscreen", making_venv=False)
    assert "This system lacks libEGL.so.1." in str(problem.value)
    install = f"{sudo}apt-get install -y --no-install-recommends libegl1"
    assert f"\n    {sudo}apt-get update && {install}" in str(problem.value)
    assert visible == []


def test_without_apt_get_the_missing_libraries_are_named(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, visible: list[str]
) -> None:
    provide_programs(monkeypatch, "sudo")
    set_missing(start, monkeypatch, {"libEGL.so.1": "libegl1", "libGL.so.1": "libgl1"})
    with pytest.raises(start.SetUpError, match=r"lacks libEGL\.so\.1, libGL\.so\.1\."):
        start.provide_system_parts("offscreen", making_venv=False)
    assert visible == []


@pytest.mark.parametrize(
    ("installs", "words"), [(False, "apt-get could not install"), (True, "still lacks libEGL.so.1")]
)
def test_an_installation_that_brings_nothing_is_an_error(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, installs: bool, words: str
) -> None:
    provide_programs(monkeypatch, "apt-get")
    monkeypatch.setattr(start, "root_prefix", list)
    monkeypatch.setattr(start, "run_visibly", lambda command: installs)
    set_missing(start, monkeypatch, *[{"libEGL.so.1": "libegl1"}] * 2)
    with pytest.raises(start.SetUpError, match=words):
        start.provide_system_parts("offscreen", making_venv=False)
