"""Edges lie where a profile crosses one half, and chips on the lattice that edges have."""

import numpy as np
import pytest
from model.photo.chips.edge_kinds import edges_at

from occ_model.photo.chips.edges import (
    Edges,
    certainty,
    chips_between,
    coherence,
    edges_of,
    find_coarsest,
    lattice_at,
)

COLUMNS = 9.0
CHIPS = np.array([0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0], dtype=np.uint8)


def test_an_edge_lies_between_its_columns_by_what_either_shows() -> None:
    found = edges_of(np.array([0.0, 0.0, 0.2, 1.0, 1.0, 0.9, 0.1, 0.0]))
    assert found.rising == pytest.approx([2.375])
    assert found.falling == pytest.approx([5.5])
    assert found.place.tolist() == [*found.rising, *found.falling]


@pytest.mark.parametrize("side", [1, -1])
def test_a_column_of_exactly_one_half_is_the_edge(side: int) -> None:
    found = edges_of(np.array([0.0, 0.0, 0.5, 1.0, 1.0])[::side])
    assert (found.rising if side > 0 else found.falling).tolist() == [2.0]


def test_noise_about_one_half_is_no_edge_and_its_middle_is_the_edge() -> None:
    found = edges_of(np.array([0.0, 0.6, 0.4, 0.6, 1.0, 0.6, 0.45, 0.9]))
    # Three crossings on the way up make one edge, in their mean; a dip makes none.
    assert found.falling.size == 0
    assert found.rising == pytest.approx([np.mean([5.0 / 6.0, 1.5, 2.5])])


def test_the_shortest_runs_are_taken_of_either_kind_without_the_outermost() -> None:
    edges = edges_at([0.0, 10.0, 18.0], [1.0, 13.0, 23.0])
    # Gaps: 1, 9, 3, 5, 5; the first and the last may be cut short.
    assert edges.shortest_pair == 3.0 + 5.0
    assert edges_at([0.0], []).shortest_pair == np.inf


def edges_of_chips(off: np.ndarray | float = 0.0, longer: float = 0.0) -> Edges:
    """Return the edges of the chips, each off its place by so much; bright runs are longer."""
    change = np.diff(CHIPS.astype(int))
    rises = change[change != 0] > 0
    places = COLUMNS * (np.flatnonzero(change) + 1.0) + 4.0 + off
    return Edges(places + np.where(rises, -longer / 2, longer / 2), rises)


@pytest.mark.parametrize("longer", [0.0, 3.0, -3.0])
def test_chips_come_back_from_their_edges_though_bright_runs_are_longer(longer: float) -> None:
    edges = edges_of_chips(longer=longer)
    lattice = find_coarsest(edges)
    assert 1.0 / lattice.frequency == pytest.approx(COLUMNS, rel=1e-3)
    assert lattice.coherence == pytest.approx(1.0, abs=1e-3)
    found = chips_between(edges, lattice)
    assert found[0].tolist() == CHIPS[1:-1].tolist()
    apart = (lattice.falling - lattice.rising + 0.5) % 1.0 - 0.5
    assert apart == pytest.approx(longer / COLUMNS, abs=0.01)
    assert abs(lattice.falling - lattice.rising) <= 0.5


def test_coherence_is_that_of_both_kinds_by_themselves() -> None:
    edges = edges_of_chips(longer=4.0)
    both = coherence(edges, np.array([1.0 / COLUMNS, 0.5 / COLUMNS, 0.137]))
    assert both[0] == pytest.approx(1.0)
    assert both[1:].max() < 0.9


def test_edges_that_do_not_alternate_on_a_lattice_have_no_chips() -> None:
    edges = edges_of_chips()
    doubled = edges_at([*edges.rising, edges.rising[2] + 0.5], edges.falling)
    assert chips_between(doubled, lattice_at(doubled, 1.0 / COLUMNS)) is None
    assert find_coarsest(edges.where(slice(3))) is None


def test_the_surer_the_nearer_edges_lie_to_their_chips() -> None:
    random = np.random.default_rng(4)
    exact = edges_of_chips()
    off, lattice = COLUMNS * random.normal(size=len(exact)), lattice_at(exact, 1.0 / COLUMNS)
    sure = [certainty(edges_of_chips(part * off), lattice) for part in (0.0, 0.1, 0.2, 0.4)]
    assert sure[0] > 0.98
    assert sure[0] >= sure[1] > sure[2] > sure[3]
    assert sure[3] < 0.5


def test_random_edges_are_not_sure_and_few_are_not_either() -> None:
    random = np.random.default_rng(9)
    sure = []
    for _ in range(60):
        places = np.sort(random.uniform(0.0, 200.0, 20))
        edges = Edges(places, np.arange(20) % 2 == 0)
        sure.append(certainty(edges, lattice_at(edges, 1.0 / COLUMNS)))
    assert np.mean(sure) < 0.15
    few = edges_at([4.0, 22.0], [13.0, 31.0])
    assert certainty(few, lattice_at(few, 1.0 / COLUMNS)) == 0.0
