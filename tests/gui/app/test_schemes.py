"""Line codes, framings and payloads that the user chooses or types."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from gui.user import User
from model.plugins.installed_package import importable
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.scene.parameter_rows import CountRow, OpenChoiceRow, ParameterRow, PatternRow
from occ_model import plugins
from occ_model.scene.from_text import change_scene


def row(application: Application, name: str) -> ParameterRow:
    panels = application.controls.panels.values()
    return next(panel.rows[name] for panel in panels if name in panel.rows)


def choose(application: Application, user: User, name: str, choice: str) -> None:
    control = row(application, name)
    assert isinstance(control, OpenChoiceRow)
    control.field.setCurrentText(choice)
    control.field.textActivated.emit(choice)
    user.wait_until_idle()


def test_a_text_typed_for_the_code_is_sent_read_and_shown(
    application: Application, user: User, qtbot: QtBot
) -> None:
    field = application.controls.code.bits
    field.selectAll()
    qtbot.keyClicks(field, "text:HI")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    user.wait_until_idle()
    choose(application, user, "line_code", "4b6b")
    choose(application, user, "framing", "c-ook")
    transmitter = application.scene_store.scene.transmitter
    assert (transmitter.payload, transmitter.line_code, transmitter.framing) == (
        "text:HI", "4b6b", "c-ook",
    )  # fmt: skip
    view = application.view("decode")
    assert view.verdict.text() == "✓ “HI” read, all bits right"
    assert view.payload.accessibleDescription() == "sent HI, received HI, 0 wrong"
    for _ in range(3):
        application.scene_store.undo_stack.undo()
    user.wait_until_idle()
    assert view.verdict.text() == "✓ Code 718 read, all bits right"
    assert view.payload.isHidden()


PAPER, C_OOK = dict[str, str](), {"line_code": "4b6b", "framing": "c-ook"}


@pytest.mark.parametrize(
    ("typed", "letters", "scheme"),
    [
        ("Hi😀", "Hi😀", C_OOK),
        ("718", "718", PAPER),
        pytest.param("0x48 69", ["48", "69"], C_OOK, marks=pytest.mark.whole),
    ],
    ids=["emoji", "digits", "hex"],
)
def test_all_panes_show_that_the_typed_payload_is_sent(
    application: Application,
    user: User,
    qtbot: QtBot,
    typed: str,
    letters: str | list[str],
    scheme: dict[str, str],
) -> None:
    # The distance is small enough for two packets with the longest payload.
    scenes = application.scene_store
    scenes.put(scenes.scene.replace(distance=0.6, **scheme), "scheme")
    field = row(application, "payload")
    assert isinstance(field, PatternRow)
    field.field.setText(typed)
    qtbot.keyClick(field.field, Qt.Key.Key_Return)
    user.wait_until_idle()
    scene = application.scene_store.scene
    assert change_scene(scene.replace(payload=""), [f"payload={typed}"]) == scene
    bits = scene.transmitter.payload_length
    code, count = application.controls.code, row(application, "bits")
    assert isinstance(count, CountRow)
    assert code.bits.text() == field.field.text()
    assert code.title.text().endswith(f": {bits} bits")
    assert (count.field.value(), count.field.isEnabled()) == (bits, False)
    rows = application.story.rows
    assert [letter.sent for letter in rows.light.letters] == list(letters)
    assert [letter.received for letter in rows.code.letters] == list(letters)
    assert rows.light.describe_sent().endswith(f", {bits} bits")
    assert len(application.view("decode").strip.sent) == bits
    code.bits.clear()
    qtbot.keyClick(code.bits, Qt.Key.Key_Return)
    user.wait_until_idle()
    assert (count.field.value(), count.field.isEnabled()) == (10, True)
    assert (field.field.text(), code.bits.text()) == ("", "1011001110")
    assert rows.light.describe_sent() == "code 718, 10 bits"


def test_incompatible_line_code_and_framing_are_refused_at_both_fields(
    application: Application, user: User
) -> None:
    choose(application, user, "line_code", "nrz")
    choose(application, user, "framing", "c-ook")
    for name in ("line_code", "framing"):
        notice = row(application, name).notice
        assert "'nrz', which does not limit runs" in notice.text()
    choose(application, user, "line_code", "manchester")
    assert application.view("decode").verdict.text() == "✓ Code 718 read, all bits right"
    assert row(application, "framing").notice.text() == ""


@pytest.fixture
def plugins_of_decoders(tmp_path: Path) -> Iterator[None]:
    """Install a decoder that reads nothing and one that cannot be imported."""
    module = (
        "import occ_model as occ\n"
        "def read(signal, scene):\n"
        "    return occ.DecodeResult('nothing', signal=signal, failure='Nothing is looked for.')\n"
        "DECODER = occ.Decoder('nothing', 'Nothing', read)\n"
    )
    names = {"nothing": "reads_nothing:DECODER", "gone": "reads_nothing:GONE"}
    with importable(tmp_path, "reads-nothing", {plugins.DECODERS: names}, module):
        yield


@pytest.mark.usefixtures("plugins_of_decoders")
@pytest.mark.own_window
def test_decoders_of_plugins_have_tabs_and_say_why_they_fail(
    application: Application, user: User, qtbot: QtBot
) -> None:
    view = application.view("decode")
    tabs = [view.decoders.tabText(place) for place in range(view.decoders.count())]
    assert tabs[-2:] == ["nothing", "gone"]
    # Plug-ins are sought after the first picture.
    qtbot.waitUntil(lambda: application.story.decoder.findData("nothing") >= 0)
    for place, text in ((-2, "Nothing is looked for."), (-1, "The plug-in 'gone' of the package")):
        view.decoders.setCurrentIndex(len(tabs) + place)
        user.wait_until_idle()
        assert text in view.reason.text()
