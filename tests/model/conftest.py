"""What the tests of the model share."""

from collections.abc import Callable, Iterator
from functools import partial

import pytest
from amount import amount
from model.plugins.installed_package import forget_plugins, offer


@pytest.fixture
def plain_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write figures coarsely, every day without placing their axes, which takes longest.

    `figures/test_page.py` holds how they are placed.
    """
    from occ_model.figures import drawing  # not before a figure is drawn: it takes long

    plain = {"figure.constrained_layout.use": False, "figure.dpi": 60, "pdf.fonttype": 3}
    for name, value in amount(plain, {}).items():
        monkeypatch.setitem(drawing.STYLE, name, value)


@pytest.fixture
def offer_decoders(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., None]]:
    """Give a function that offers decoders as plug-ins, until the test ends."""
    yield partial(offer, monkeypatch)
    monkeypatch.undo()
    forget_plugins()
