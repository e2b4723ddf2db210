"""Stores for tests of controllers and panes."""

from dataclasses import replace
from typing import Any

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.scene.scene_store import SceneStore
from occ_model.effects.registry import EFFECTS
from occ_model.scene.scene import Scene


def store_of(scene: Scene | None = None) -> SceneStore:
    workspace = Workspace(Scene() if scene is None else scene)
    return SceneStore(Store(workspace), {effect.name: effect.label for effect in EFFECTS})


def show(store: Store, **changes: Any) -> None:
    store.put(replace(store.workspace, **changes))
