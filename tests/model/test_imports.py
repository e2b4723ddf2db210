"""The model stands alone: no window, and nothing slow at start-up."""

import ast
import inspect
import subprocess
import sys
from functools import cached_property
from pathlib import Path
from types import FunctionType

import pytest

HEAVY = ("PySide6", "pyqtgraph", "superqt", "matplotlib", "scipy", "skimage", "PIL", "pandas")

PROCESSES = {"concurrent.futures.process", "multiprocessing", "distributed", "tqdm"}
"""What only several processes need."""

BLOCK = f"""
import sys

class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {HEAVY!r}:
            raise ImportError(f"{{name}} is blocked here")

sys.meta_path.insert(0, Blocked())
"""

USE = """
import numpy as np
import occ_model as occ

scene = occ.load_preset("phone-136us").replace(rows=300, code=718)
scene = occ.Scene.from_toml(scene.to_toml())
frame = occ.render(scene)
result = occ.decode(frame.image, scene)
print(result.code, frame.image.shape)
"""


def run(program: str) -> list[str]:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout.split()


@pytest.mark.parametrize("module", ["occ_model", "occ_model.cli"])
def test_importing_the_model_imports_nothing_unneeded(module: str) -> None:
    loaded = run(f"import sys, {module}; print(*sys.modules)")
    assert module in loaded
    assert {name.partition(".")[0] for name in loaded} & {*HEAVY, "occ_gui"} == set()


def test_a_scene_is_decoded_without_the_heavy_packages() -> None:
    assert run(BLOCK + USE) == ["718", "(300,", "3456)"]


def test_the_blocked_names_are_really_blocked() -> None:
    probe = "try:\n    import PIL\nexcept ImportError as error:\n    print(error)\n"
    assert run(BLOCK + probe) == ["PIL", "is", "blocked", "here"]


def test_simulating_imports_nothing_heavy_either() -> None:
    loaded = run(f"{USE}\nocc.sweep\nimport sys; print(*sys.modules)")
    assert {"occ_model.simulation.render", "occ_model.study.sweep.sweep"} <= {*loaded}
    assert {name.partition(".")[0] for name in loaded} & {*HEAVY, "occ_gui"} == set()
    assert {*loaded} & PROCESSES == set()


def test_type_checkers_see_where_each_public_name_comes_from() -> None:
    import occ_model

    source = ast.parse(Path(occ_model.__file__).read_text(encoding="utf-8"))
    seen = {
        alias.asname: f"{node.module}"
        for node in ast.walk(source)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
        if alias.asname == alias.name  # a name that is public by that
    }
    modules = {**occ_model._MODULES, "__version__": "version"}
    assert seen == {name: f"occ_model.{module}" for name, module in modules.items()}


def test_every_public_name_is_there() -> None:
    import occ_model

    assert sorted(occ_model.__all__) == list(occ_model.__all__)
    assert [name for name in occ_model.__all__ if not hasattr(occ_model, name)] == []


def test_no_plugin_is_looked_for_while_built_in_names_are_used() -> None:
    scheme = "code=718, line_code='4b6b', framing='raw'"
    loaded = run(f"{USE.replace('code=718', scheme)}\nimport sys; print(*sys.modules)")
    assert "occ_model.transmitter.line_codes._4b6b" in loaded
    assert "occ_model.transmitter.line_codes._8b10b" not in loaded
    assert "importlib.metadata" not in loaded


def test_all_that_the_package_offers_says_what_it_is() -> None:
    import occ_model

    silent = []
    for name in occ_model.__all__:
        offered = getattr(occ_model, name)
        if not (inspect.isfunction(offered) or inspect.isclass(offered)):
            continue
        parts: dict[str, object] = {name: offered}
        if inspect.isclass(offered):
            own = [kind for kind in offered.__mro__ if kind.__module__.startswith("occ_model")]
            parts |= {
                f"{name}.{key}": part
                for kind in own
                for key, part in vars(kind).items()
                if not key.startswith("_")
                and isinstance(part, FunctionType | property | cached_property | classmethod)
            }
        silent += [key for key, part in parts.items() if not inspect.getdoc(part)]
    assert silent == []
