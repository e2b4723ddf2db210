"""The fitted stripes lie over those of the photo that they explain."""

import numpy as np
import pyqtgraph as pg
from matches import match_of_lamp
from PySide6.QtCore import QRectF
from PySide6.QtWidgets import QApplication

from occ_gui.photo.fitted_stripes import FittedStripes, stripes_of


def test_fitted_stripes_cover_all_columns_and_a_third_of_the_rows(qapp: QApplication) -> None:
    box, match = pg.ViewBox(), match_of_lamp()
    stripes = FittedStripes(box)
    assert not any(item.isVisible() for item in stripes.items)
    stripes.show_match(match)
    region = match.region
    expected = QRectF(
        region.first_column - 0.5,
        region.first_row - 0.5,
        region.columns,
        max(1, round(region.rows / 3)),
    )
    assert stripes.frame.rect() == stripes.picture.boundingRect() == expected
    assert all(item.isVisible() for item in stripes.items)
    assert stripes.picture.image.shape == (1, len(match.profile))
    assert np.abs(stripes_of(match)[0] - match.profile).max() <= 0.5
    stripes.show_match(None)
    assert not any(item.isVisible() for item in stripes.items)
