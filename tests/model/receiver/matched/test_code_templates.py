"""The forward model of every code: its levels, and its energies."""

from fractions import Fraction

import numpy as np
import pytest

from occ_model.receiver.matched.templates import code_templates


@pytest.mark.parametrize("bits", [2, 5])
@pytest.mark.parametrize("exposure", [Fraction(1, 2), Fraction(7, 3)])
def test_levels_are_quantiles_of_all_codes_profiles(bits: int, exposure: Fraction) -> None:
    """As many evenly spaced ones as there are bins."""
    templates = code_templates(bits, exposure)
    profiles = templates.profiles(np.arange(2**bits))
    bins = profiles.shape[1]
    expected = np.quantile(profiles, (np.arange(bins) + 0.5) / bins)
    assert templates.levels == pytest.approx(expected, abs=1e-9)
