"""The list of all effects, in their order along the light's path."""

from collections.abc import Collection
from functools import lru_cache
from typing import TypeVar

from occ_model.effects.distortion import Distortion
from occ_model.effects.effect import Effect
from occ_model.effects.light_effects import Flicker, LedEdges
from occ_model.effects.optics_effects import Defocus, Emission, Vignetting
from occ_model.effects.sensor_effects import FixedPattern, FullWell, Jpeg, SensorNoise

EFFECTS: tuple[Effect, ...] = (
    LedEdges(),
    Flicker(),
    Emission(),
    Distortion(),
    Defocus(),
    Vignetting(),
    FullWell(),
    FixedPattern(),
    SensorNoise(),
    Jpeg(),
)

NAMES: tuple[str, ...] = tuple(effect.name for effect in EFFECTS)

_Kind = TypeVar("_Kind", bound=Effect)


def effects_named(names: Collection[str], kind: type[_Kind]) -> tuple[_Kind, ...]:
    """Return the effects of a kind with these names, in order."""
    return tuple(effect for effect in _effects_of_kind(kind) if effect.name in names)


@lru_cache(maxsize=16)
def _effects_of_kind(kind: type[_Kind]) -> tuple[_Kind, ...]:
    return tuple(effect for effect in EFFECTS if isinstance(effect, kind))
