"""Set the project up in a virtual environment, then start the application or the checks.

    python3 resources/start.py [application arguments]
    python3 resources/start.py test [pytest arguments]

Only the standard library is needed. What is already installed is kept, so that every start after
the first takes a fraction of a second. Messages go to standard error: standard output belongs to
the application.
"""

import hashlib
import importlib.util
import json
import os
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

OLDEST, NEWEST_TRIED = (3, 11), (3, 14)


def version_problem(major: int, minor: int) -> str:
    """Return why this Python cannot run the project; '' if it can."""
    if (major, minor) >= OLDEST:
        return ""
    return (
        f"This project needs Python 3.11 or newer, and this is Python {major}.{minor}. "
        "Start it with a newer one, for example: python3.13 resources/start.py"
    )


# Checked before anything below is defined: an older Python 3 can parse the rest of this file, but
# cannot evaluate its annotations.
if version_problem(*sys.version_info[:2]):
    sys.exit(version_problem(*sys.version_info[:2]))

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
from occ_gui.app.system_libraries import (  # noqa: E402 - no older Python can import it
    APT_INSTALL,
    find_missing_libraries,
    write_install_command,
)

VENV = ROOT / ".venv"
PROGRAMS = VENV / ("Scripts" if os.name == "nt" else "bin")
PYTHON = PROGRAMS / ("python.exe" if os.name == "nt" else "python")
STAMP = VENV / "start.json"
UNFINISHED = VENV / "unfinished"
RUNNING = "{}.{}".format(*sys.version_info)

# The extra of the window, which every start installs; the model alone does not need it.
WINDOW = "gui"

# Programs and headers that compile and run the sketches of boards, for tests in CI.
TEST_TOOLS = {
    "avr-g++": "gcc-avr",
    "g++": "g++",
    "/usr/lib/avr/include/avr/io.h": "avr-libc",
    "/usr/include/simavr/sim_avr.h": "libsimavr-dev",
    "/usr/include/libelf.h": "libelf-dev",
}
# While this variable is set, Python keeps no compiled modules.
UNCOMPILED = "PYTHONDONTWRITEBYTECODE"
# Arguments with which the application opens no window.
WINDOWLESS = {"--screenshot", "--help", "-h", "--version"}


class SetUpError(Exception):
    """The project cannot be started; the message says why, and what to do."""


def say(message: str) -> None:
    """Print a message of the set-up."""
    print(message, file=sys.stderr, flush=True)


def run_visibly(command: Sequence[str], **settings: str) -> bool:
    """Run a command with its output on standard error; return whether it succeeded."""
    environment = {**os.environ, **settings}
    return subprocess.run(command, cwd=ROOT, env=environment, stdout=2, check=False).returncode == 0


def qt_platform(arguments: Iterable[str], environment: Mapping[str, str]) -> str:
    """Return the Qt platform that this start will use; '' if there is no display."""
    if sys.platform != "linux":
        return "native"
    if any(argument.split("=")[0] in WINDOWLESS for argument in arguments):
        return "offscreen"
    # Qt's variable is a list separated by semicolons; options may follow each name.
    chosen = environment.get("QT_QPA_PLATFORM", "").split(";")[0].split(":")[0]
    if chosen and not chosen.startswith(("xcb", "wayland")):
        return chosen
    if environment.get("WAYLAND_DISPLAY") and chosen != "xcb":
        return "wayland"
    return "xcb" if environment.get("DISPLAY") else ""


def has_font() -> bool:
    """Return whether one of Qt's folders of fonts has a font."""
    home = os.environ.get("HOME", "")
    folders = (
        "/usr/share/fonts",
        "/usr/local/share/fonts",
        f"{home}/.fonts",
        f"{home}/.local/share/fonts",
    )
    return any(True for folder in folders for _ in Path(folder).rglob("*.[ot]t[cf]"))


def missing_parts(platform: str, making_venv: bool) -> dict[str, str]:
    """Return the missing parts of the system, each with the Debian package that contains it."""
    missing = find_missing_libraries(platform)
    # Systems without apt-get may have their fonts in other folders.
    if shutil.which("apt-get") and not has_font():
        missing["a font"] = "fonts-dejavu-core"
    # A package of its own in Debian, without which a virtual environment has no pip.
    importlib.invalidate_caches()
    if making_venv and importlib.util.find_spec("ensurepip") is None:
        missing["Python's ensurepip"] = f"python{RUNNING}-venv"
    return missing


def root_prefix() -> list[str] | None:
    """Return the words before a command that runs as root; None if that is impossible."""
    if os.geteuid() == 0:
        return []
    if shutil.which("sudo") is None:
        return None
    free = subprocess.run(["sudo", "-n", "true"], capture_output=True, check=False)
    return ["sudo"] if free.returncode == 0 or os.isatty(0) else None


def install_packages(prefix: Iterable[str], packages: Iterable[str]) -> bool:
    """Install Debian packages; return whether that succeeded."""
    as_root = [*prefix, "env", "DEBIAN_FRONTEND=noninteractive"]
    # If the update fails, the old list of packages is often sufficient.
    run_visibly([*as_root, "apt-get", "update"])
    return run_visibly([*as_root, *APT_INSTALL, *packages])


def provide_system_parts(platform: str, making_venv: bool) -> None:
    """Install what Qt and pip need of the system and is missing, if that is allowed."""
    missing = missing_parts(platform, making_venv) if sys.platform == "linux" else {}
    if not missing:
        return
    lacks = "This system lacks " + ", ".join(missing)
    if shutil.which("apt-get") is None:
        raise SetUpError(f"{lacks}. Install it, then start again.")
    line = write_install_command(missing.values())
    remedy = f"Run this line as root, then start again:\n    {line}"
    prefix = root_prefix()
    if prefix is None:
        raise SetUpError(f"{lacks}. {remedy}")
    say(f"{lacks}. Installing {', '.join(missing.values())} ...")
    if not install_packages(prefix, missing.values()):
        raise SetUpError(f"apt-get could not install what is missing; see above. {remedy}")
    still = missing_parts(platform, making_venv)
    if still:
        raise SetUpError(f"apt-get ran, yet this Python still lacks {', '.join(still)}.")


def missing_tools() -> list[str]:
    """List the Debian packages of missing tools of the tests."""
    return [
        package
        for name, package in TEST_TOOLS.items()
        if not (Path(name).is_file() if "/" in name else shutil.which(name))
    ]


def offer_test_tools() -> None:
    """Install the tests' tools if that is allowed; without them some tests are skipped."""
    packages = missing_tools() if sys.platform == "linux" else []
    prefix = root_prefix() if packages and shutil.which("apt-get") else None
    if prefix is None:
        return
    say(f"Installing {', '.join(packages)} for the tests of boards ...")
    if not install_packages(prefix, packages):
        say("apt-get could not; the tests that need them are skipped.")


def read_stamp() -> dict[str, Any]:
    """Return the record of the last complete installation; {} if there is none."""
    try:
        return dict(json.loads(STAMP.read_text()))
    except (OSError, TypeError, ValueError):
        return {}


def wanted_stamp(python: str, extras: Iterable[str]) -> dict[str, Any]:
    """Return the record of an installation that suits the project as it is now."""
    project = hashlib.sha256((ROOT / "pyproject.toml").read_bytes()).hexdigest()
    return {"pyproject": project, "python": python, "root": str(ROOT), "extras": sorted(extras)}


def serves(stamp: Mapping[str, Any], wanted: Mapping[str, Any]) -> bool:
    """Return whether an installation is the wanted one, or has more extras."""
    same = {**stamp, "extras": None} == {**wanted, "extras": None}
    return same and set(wanted["extras"]) <= set(stamp["extras"])


def venv_version() -> str:
    """Return the version of the virtual environment's Python; '' if it cannot be used."""
    moved = read_stamp().get("root", str(ROOT)) != str(ROOT)  # its programs contain the old path
    if moved or UNFINISHED.exists():
        return ""
    question = [str(PYTHON), "-I", "-c", "import pip, sys; print(*sys.version_info[:2])"]
    try:
        asked = subprocess.run(question, capture_output=True, text=True, check=False)
    except OSError:
        return ""
    version = asked.stdout.split() if asked.returncode == 0 else []
    supported = bool(version) and not version_problem(*map(int, version))
    return ".".join(version) if supported else ""


def make_venv() -> None:
    """Make a new virtual environment in place of an existing one."""
    if VENV.is_symlink() or VENV.is_file():
        VENV.unlink()
    elif VENV.exists():
        say("Making .venv anew: the one there is unfinished, moved or of an unsupported Python.")
        shutil.rmtree(VENV)
    VENV.mkdir()
    UNFINISHED.touch()
    if sys.version_info[:2] > NEWEST_TRIED:
        tried = "{}.{}".format(*NEWEST_TRIED)
        say(f"This Python {RUNNING} is newer than {tried}, the newest that was tried; going on.")
    # Not sys.executable, which may be in the folder that was just removed.
    python = getattr(sys, "_base_executable", None) or sys.executable
    venv = [python, "-m", "venv", str(VENV)]
    made = subprocess.run(venv, capture_output=True, text=True, check=False)
    if made.returncode != 0:
        say((made.stdout + made.stderr).strip())
        raise SetUpError("Python could not make the virtual environment .venv; see above.")
    UNFINISHED.unlink()


def compile_options(extras: Collection[str]) -> list[str]:
    """Return pip's option to compile no modules, if they are compiled when they are imported.

    Few of them ever are, and compiling all takes two fifths of pip's time. The checks always keep
    compiled modules.
    """
    return ["--no-compile"] if "test" in extras or UNCOMPILED not in os.environ else []


def install_project(python: str, extras: Iterable[str]) -> None:
    """Let pip install the project, editable, and record the complete installation."""
    stamp = read_stamp()
    extras = {*extras, *stamp.get("extras", ())}  # those of `test` stay installed
    occasion = "something changed since the last time" if stamp else "first start only"
    say(f"Installing the project into .venv ({occasion}, a minute or two) ...")
    STAMP.unlink(missing_ok=True)  # a pip that is stopped half-way must run again
    target = f".[{','.join(sorted(extras))}]"
    # If there is no wheel of PyAV, pip reports it: a build would need all of FFmpeg.
    wheels = ["--only-binary", "av"]
    pip = [str(PYTHON), "-m", "pip", "install", *compile_options(extras), *wheels, "-e", target]
    if not run_visibly(pip, PIP_DISABLE_PIP_VERSION_CHECK="1"):
        raise SetUpError(
            "pip could not install the project; its messages are above. "
            "Check the network connection and the free disk space, then start again."
        )
    STAMP.write_text(json.dumps(wanted_stamp(python, extras), indent=2))


@contextmanager
def one_at_a_time() -> Iterator[None]:
    """Let only one start of the project change .venv at a time; the others wait."""
    if sys.platform == "win32":
        yield
        return
    import fcntl

    # This script is locked, so that no lock file is left behind.
    with Path(__file__).open("rb") as script:
        try:
            fcntl.flock(script, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say("Waiting for another start of the project to finish its set-up ...")
            fcntl.flock(script, fcntl.LOCK_EX)
        except OSError:
            pass  # some network file systems have no locks
        yield


def set_up(platform: str, extras: Iterable[str]) -> None:
    """Install what is missing, from system libraries to the project itself."""
    python = venv_version()
    provide_system_parts(platform, making_venv=not python)
    if "test" in extras and os.environ.get("CI"):
        offer_test_tools()
    if not python:
        make_venv()
        python = RUNNING
    elif python != RUNNING:
        say(f"Using the Python {python} of .venv; remove .venv to use this Python {RUNNING}.")
    if not serves(read_stamp(), wanted_stamp(python, extras)):
        install_project(python, extras)


def usable_cores() -> int:
    """Count the processor's cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run_check(check: str, *, quietly: bool) -> tuple[bool, str, float]:
    """Run one check; return whether it passed, its output unless it is shown, and the seconds."""
    program, *arguments = shlex.split(check)
    # mypy and ruff write sentences on standard output, and their own failures on standard error.
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT} if quietly else {}
    command = [str(PROGRAMS / program), *arguments]
    # Modules are compiled once, not by each of the hundreds of processes that the tests start.
    environment = {name: value for name, value in os.environ.items() if name != UNCOMPILED}
    start = time.monotonic()
    done = subprocess.run(command, cwd=ROOT, env=environment, check=False, text=True, **pipes)
    return done.returncode == 0, (done.stdout or "").strip(), time.monotonic() - start


def run_checks(pytest_arguments: Sequence[str]) -> int:
    """Run every check of the project, even if some fail; return the exit code.

    The tests use all cores and show their progress and the slowest ten. The other checks run
    meanwhile, one after the other. At the end each check is reported in a line, and a failed one
    with its output before it.
    """
    # By default, pytest-xdist also counts cores that this process may not use, and only half of
    # those that run two threads.
    os.environ.setdefault("PYTEST_XDIST_AUTO_NUM_WORKERS", str(usable_cores()))
    # Each process gets a sequence of neighbouring tests, so that few fixtures are made twice.
    pytest = ["pytest", "-n", "auto", "--dist", "worksteal", "--durations", "10"]
    tests = shlex.join([*pytest, *pytest_arguments])
    others = ["ruff check .", "ruff format --check .", "mypy", "lint-imports"]
    with ThreadPoolExecutor(max_workers=1) as pool:
        reports = {check: pool.submit(run_check, check, quietly=True) for check in others}
        try:
            print(tests, flush=True)
            results = {tests: run_check(tests, quietly=False)}
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            raise
        results |= {check: report.result() for check, report in reports.items()}
    for check, (good, output, seconds) in results.items():
        last = output.splitlines()[-1:] if good else []
        print("" if good else f"\n{check}\n{output}\n", end="")
        print(f"{'passed' if good else 'FAILED'} {seconds:5.0f} s ", ": ".join([check, *last]))
    failed = [check for check, (good, _, _) in results.items() if not good]
    print(f"Failed: {'; '.join(failed)}" if failed else "Every check passed.", flush=True)
    return 1 if failed else 0


def start_application(arguments: Sequence[str]) -> int:
    """Start the application, in place of this process if the system allows that."""
    command = [str(PYTHON), "-m", "occ_gui", *arguments]
    if sys.platform == "win32":
        return subprocess.run(command, check=False).returncode
    return os.execv(command[0], command)


def main(arguments: Sequence[str]) -> int:
    """Set up the project, and start the application or the checks; return the exit code."""
    testing = list(arguments[:1]) == ["test"]
    if testing:
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    platform = qt_platform(arguments, os.environ)
    try:
        with one_at_a_time():
            set_up(platform, extras=[WINDOW, "test"] if testing else [WINDOW])
        if testing:
            return run_checks(arguments[1:])
        if not platform:
            raise SetUpError(
                "There is no display for a window: neither DISPLAY nor WAYLAND_DISPLAY is set. "
                "This command draws the window to a picture instead:\n"
                "    python3 resources/start.py --screenshot window.png"
            )
        return start_application(arguments)
    except SetUpError as problem:
        say(str(problem))
        return 1
    except OSError as error:
        say(f"The set-up could not go on: {error}")
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
