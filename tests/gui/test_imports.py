"""What may know of what in the window: views show what they are given and know no physics."""

from graphlib import TopologicalSorter

import grimp
import pytest

PHYSICS = (
    "camera",
    "commands",
    "effects",
    "figures",
    "photo.camera",
    "photo.comparison",
    "photo.fit",
    "photo.match",
    "photo.stripes",
    "receiver",
    "scene.presets",
    "simulation",
    "study",
    "teaching",
    "transmitter",
)
"""The modules and packages of the model that compute, or read and write files."""

MAY_COMPUTE = (
    "animation",
    "answers",
    "column_facts",
    "controller",
    "comparison",
    "feature",
    "jobs",
    "measurement",
    "pane",
    "photo_work",
    "record",
    "report",
    "schedule",
    "wiring",
    "worker",
)
"""What the names of the window's modules end with that may use them, beside all of ``app``."""


@pytest.fixture(scope="module")
def imports() -> dict[str, set[str]]:
    """Return the modules of the model that each module of the window imports by itself."""
    graph = grimp.build_graph("occ_gui", "occ_model")
    window = [module for module in graph.modules if module.startswith("occ_gui")]
    return {
        module: {
            name.removeprefix("occ_model.")
            for name in graph.find_modules_directly_imported_by(module)
            if name.startswith("occ_model")
        }
        for module in window
    }


def may_compute(module: str) -> bool:
    """Whether a module of the window may use the physics, by its name."""
    folder = module.removeprefix("occ_gui.").partition(".")[0]
    return folder == "app" or module.endswith(MAY_COMPUTE)


def is_physics(module: str) -> bool:
    """Whether a module of the model computes, or is the whole package, which gives everything."""
    return module == "occ_model" or any(
        module == part or module.startswith(f"{part}.") for part in PHYSICS
    )


def test_views_know_no_physics(imports: dict[str, set[str]]) -> None:
    known = {
        module: sorted(filter(is_physics, found))
        for module, found in imports.items()
        if not may_compute(module)
    }
    assert {module: found for module, found in known.items() if found} == {}


def test_controllers_are_seen_to_use_the_physics(imports: dict[str, set[str]]) -> None:
    assert is_physics("occ_model")
    assert any(map(is_physics, imports["occ_gui.simulation.controller"]))
    assert any(map(is_physics, imports["occ_gui.photo.match_controller"]))


def test_each_name_of_the_physics_is_one_of_the_model() -> None:
    graph = grimp.build_graph("occ_model")
    assert {f"occ_model.{part}" for part in PHYSICS} <= graph.modules


def test_no_modules_of_the_window_import_each_other_not_even_for_types() -> None:
    graph = grimp.build_graph("occ_gui")
    modules = [module for module in graph.modules if module.startswith("occ_gui")]
    order = TopologicalSorter({m: graph.find_modules_directly_imported_by(m) for m in modules})
    assert set(order.static_order()) >= set(modules)  # it raises CycleError, with the circle
