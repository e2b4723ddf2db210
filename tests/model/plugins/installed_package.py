"""Packages with entry points, installed into a folder as an installer would."""

import importlib.metadata
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib.metadata import EntryPoint
from pathlib import Path
from types import ModuleType

import pytest

from occ_model import plugins
from occ_model.receiver import decode
from occ_model.receiver.decoder import Decoder
from occ_model.results.decoding import DecodeResult
from occ_model.transmitter import scheme
from occ_model.transmitter.registry import Registry

_CACHES = (
    plugins._find_entries,
    decode._load_plugin,
    Registry.get,
    scheme.scheme_named,
    scheme._payload_chips,
)


def forget_plugins() -> None:
    """Let the program look for plug-ins anew."""
    for cache in _CACHES:
        cache.cache_clear()


def install(
    folder: Path, package: str, entry_points: Mapping[str, Mapping[str, str]], module: str
) -> None:
    """Write a package of one module, with the description that installers write.

    Parameters
    ----------
    folder
        The folder of packages, such as ``site-packages``.
    package
        Its name; that of the module has underscores.
    entry_points
        Objects by name, by group.
    module
        The module's text.
    """
    name = package.replace("-", "_")
    (folder / f"{name}.py").write_text(module, encoding="utf-8")
    description = folder / f"{name}-1.0.dist-info"
    description.mkdir()
    (description / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n", encoding="utf-8"
    )
    groups = (
        f"[{group}]\n" + "".join(f"{key} = {value}\n" for key, value in objects.items())
        for group, objects in entry_points.items()
    )
    (description / "entry_points.txt").write_text("\n".join(groups), encoding="utf-8")


@contextmanager
def importable(
    folder: Path, package: str, entry_points: Mapping[str, Mapping[str, str]], module: str
) -> Iterator[None]:
    """Install a package where Python looks for packages, until the context ends."""
    install(folder, package, entry_points, module)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder)
        forget_plugins()
        yield
    forget_plugins()


def offer(monkeypatch: pytest.MonkeyPatch, **decoders: Callable[..., DecodeResult]) -> None:
    """Let an installed package seem to offer decoders, by name the function that reads."""
    module = ModuleType("offered")
    vars(module).update({name: Decoder(name, name, read) for name, read in decoders.items()})
    monkeypatch.setitem(sys.modules, "offered", module)
    entries = [EntryPoint(name, f"offered:{name}", plugins.DECODERS) for name in decoders]
    monkeypatch.setattr(
        importlib.metadata, "entry_points", lambda group: [e for e in entries if e.group == group]
    )
    forget_plugins()
