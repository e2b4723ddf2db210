"""The pane that compares the pinned states, declared."""

from occ_gui.pins.pin_controller import PinController
from occ_gui.shell.feature import Feature, Pane


def compare(pins: PinController) -> Feature[None]:
    def make() -> Pane[None]:
        from occ_gui.pins.compare_view import ComparePane

        return ComparePane(pins)

    return Feature(
        name="compare",
        title="Compare",
        help="guide.md#compare-two-states",
        make=make,
        actions={
            "pin_a": lambda: pins.pin("A"),
            "pin_b": lambda: pins.pin("B"),
            "go_to_a": lambda: pins.go_to("A"),
            "go_to_b": lambda: pins.go_to("B"),
            "clear_pins": pins.clear,
        },
    )
