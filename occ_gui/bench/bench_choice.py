"""What the bench is to measure: the choices of its pane."""

from dataclasses import dataclass

PUBLISHED, OF_SCENE = "published", "scene"
"""Whose code and timing: those of the published benchmark, or those of the scene."""

BITS = (2_560, 10_240, 102_400)  # bits at each point, of which the pane offers a choice


@dataclass(frozen=True, slots=True)
class BenchChoice:
    whose: str = PUBLISHED
    decoders: tuple[str, ...] = ()
    bits: int = BITS[1]
