"""What the tests of the model share."""

import pytest
from amount import amount


@pytest.fixture
def plain_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write figures coarsely, every day without placing their axes, which takes longest.

    `figures/test_page.py` holds how they are placed.
    """
    from occ_model.figures import drawing  # not before a figure is drawn: it takes long

    plain = {"figure.constrained_layout.use": False, "figure.dpi": 60, "pdf.fonttype": 3}
    for name, value in amount(plain, {}).items():
        monkeypatch.setitem(drawing._STYLE, name, value)
