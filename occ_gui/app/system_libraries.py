"""The shared libraries that Qt needs of a Linux system, and the packages that contain them.

Only the standard library is used: `resources/start.py` asks here before anything is installed.
"""

import ctypes
import shlex
import shutil
from collections.abc import Iterable, Mapping

# The libraries that Qt links but its wheel lacks, each with its Debian package. Their own
# dependencies are not listed, because they do not load without these. Debian 13 and Ubuntu 24.04
# renamed libglib2.0-0, which apt-get still finds by its old name.
LIBRARIES = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libfontconfig.so.1": "libfontconfig1",
    "libglib-2.0.so.0": "libglib2.0-0",
    "libxkbcommon.so.0": "libxkbcommon0",
}
# Further libraries that Qt links for each kind of display.
DISPLAY_LIBRARIES = {
    "xcb": {
        "libX11-xcb.so.1": "libx11-xcb1",
        "libxcb-cursor.so.0": "libxcb-cursor0",
        "libxcb-icccm.so.4": "libxcb-icccm4",
        "libxcb-keysyms.so.1": "libxcb-keysyms1",
        "libxcb-randr.so.0": "libxcb-randr0",
        "libxcb-shape.so.0": "libxcb-shape0",
        "libxcb-sync.so.1": "libxcb-sync1",
        "libxcb-xfixes.so.0": "libxcb-xfixes0",
        "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
    },
    "wayland": {
        "libwayland-client.so.0": "libwayland-client0",
        "libwayland-cursor.so.0": "libwayland-cursor0",
        "libwayland-egl.so.1": "libwayland-egl1",
    },
}
APT_INSTALL = ("apt-get", "install", "-y", "--no-install-recommends")


def can_load(library: str) -> bool:
    """Return whether the dynamic linker finds a shared library and its dependencies."""
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def find_missing_libraries(*platforms: str) -> dict[str, str]:
    """Map each library that the system lacks for these Qt platforms to its Debian package."""
    libraries = dict(LIBRARIES)
    for platform in platforms:
        libraries |= DISPLAY_LIBRARIES.get(platform, {})
    return {name: package for name, package in libraries.items() if not can_load(name)}


def write_install_command(packages: Iterable[str]) -> str:
    sudo = "sudo " if shutil.which("sudo") else ""
    return f"{sudo}apt-get update && {sudo}{shlex.join([*APT_INSTALL, *packages])}"


def describe_missing(missing: Mapping[str, str]) -> str:
    """Name the missing libraries, and the command that installs their packages."""
    sentence = f"No window can be opened, because this system lacks {', '.join(missing)}"
    packages = [package for package in missing.values() if package]
    if not (packages and shutil.which("apt-get")):
        return f"{sentence}; install the packages that contain them."
    return f"{sentence}; this command installs them: '{write_install_command(packages)}'."
