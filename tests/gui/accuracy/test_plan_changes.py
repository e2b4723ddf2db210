"""Which effects the latest change of a plan has switched."""

from types import SimpleNamespace
from typing import Any

from occ_gui.accuracy.plan_changes import PlanChanges


def frame_of(*included: str) -> Any:
    """A picture whose plan includes these of three effects."""
    decisions = [SimpleNamespace(effect=name) for name in ("a", "b", "c")]
    return SimpleNamespace(plan=SimpleNamespace(included=included, decisions=decisions))


def switched_by(changes: PlanChanges) -> list[str]:
    decisions: tuple[Any, ...] = changes.switched
    return [decision.effect for decision in decisions]


def test_what_is_switched_in_or_out_is_told_until_it_is_forgotten() -> None:
    changes = PlanChanges()
    assert not changes.update(frame_of("a", "b"))  # the first picture changes nothing
    assert not changes.update(frame_of("a", "b"))
    assert changes.switched == ()
    assert changes.update(frame_of("b", "c"))
    assert switched_by(changes) == ["a", "c"]
    assert not changes.update(frame_of("b", "c"))
    assert switched_by(changes) == ["a", "c"]
    changes.forget()
    assert changes.switched == ()
