"""What is done in the photo's pane is what is matched."""

from pathlib import Path

from gui.user import User

from occ_gui.app.application import Application
from occ_model.results.decoding import Region


def test_a_rectangle_that_is_drawn_is_the_one_matched(
    application: Application, user: User, photo_file: Path
) -> None:
    application.open_photo(photo_file)
    user.wait_until_idle()
    pane, form = application.shell.pane("photo"), application.view("photo").lamps
    form.by_hand.click()
    pane.outlines.drawn.emit(Region(5, 25, 10, 40))
    assert pane.parts.part == Region(5, 25, 10, 40)
    form.whole.click()
    assert pane.parts.part is None
    assert not form.by_hand.isChecked()
    form.by_hand.click()
    assert pane.parts.part is not None
    assert pane.outlines.rectangle.isVisible()
    form.search.click()
    assert not form.search.isEnabled()
    assert not application.is_idle
    user.wait_until_idle()
    assert form.search.isEnabled()
