"""A sweep whose table must be the same however it is measured."""

import pytest

import occ_model as occ
from occ_model.results.sweep import SweepTable
from occ_model.scene.scene import Scene

BOTH = ("threshold", "matched")
AXES = {"switching_frequency": [3e3, 14.65e3, 15e3, 25e3], "distance": [0.6, 1.4, 1.9]}


@pytest.fixture(scope="package")
def scene() -> Scene:
    return occ.load_preset("phone-136us")


@pytest.fixture(scope="package")
def table(scene: Scene) -> SweepTable:
    """Run the sweep in this process; all other ways must give the same table."""
    return occ.sweep(scene, AXES, 3, BOTH, 7)
