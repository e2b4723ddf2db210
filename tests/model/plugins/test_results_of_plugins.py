"""Whatever a plug-in's decoder puts into its result is checked, or is refused by name."""

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.receiver.decoders import checked_result

READ = occ.DecodeResult("own", code=1, bits=np.array([1]), chips=np.array([1, 0]))

RUBBISH: tuple[Any, ...] = (
    None, True, -1, 2**70, 1.5, float("nan"), "", "a\x1b[31m", b"\0", object(), [], [1], {}, (),
    (1, "2"), np.array(1), np.array([]), np.array([0.5, 1.0]), np.array([1, 0, 1]),
    np.zeros((2, 2)), np.array(["1", "0"]), np.array([1, None]), np.array([1j, 0]),
    np.array([np.nan, 1.0]), np.zeros(2, dtype=[("a", "u1")]), np.broadcast_to(np.uint8(0), 10**12),
    occ.Scene(), len,
)  # fmt: skip


@pytest.mark.parametrize("name", [field.name for field in fields(occ.DecodeResult)])
def test_a_part_of_a_result_is_of_its_kind_or_refused(name: str) -> None:
    reasons = []
    for value in RUBBISH:
        try:
            found = checked_result("Own", replace(READ, **{name: value}), 20)
        except occ.PluginError as error:
            reasons.append(str(error))
            continue
        assert found.failure or (isinstance(found.code, int) and found.code >= 0)
        assert set(np.unique(found.bits)) <= {0, 1}
        assert set(np.unique(found.chips)) <= {0, 1}
    assert all(reason.startswith("Own gives ") for reason in reasons)
    assert len(reasons) > len(RUBBISH) / 2 or name in ("decoder", "location")
