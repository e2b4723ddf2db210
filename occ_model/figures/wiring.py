"""Draw how a board is wired to the light, with the values' assumptions and the cautions."""

import textwrap

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model.boards.board import Board
from occ_model.boards.caution import EYES, flicker_sentence
from occ_model.boards.transmission import Transmission
from occ_model.boards.wiring import (
    GATE_CAPACITANCE,
    LED_CURRENT,
    LED_VOLTS,
    Wiring,
    wiring,
)
from occ_model.figures import circuit_symbols as symbols
from occ_model.scene.units import SECOND

_SIZE = (7.6, 6.0)
"""In inches."""

_LINE_LENGTH = 116
"""Characters of a line of text below the drawing."""


def wiring_figure(sent: Transmission) -> Figure:
    """Draw the circuit; call it within :func:`occ_model.figures.drawing.house_style`."""
    values = wiring(sent.board)
    figure = Figure(figsize=_SIZE)
    drawn, written = figure.subplots(2, 1, height_ratios=(3.4, 2.6))
    for axes in (drawn, written):
        axes.set_axis_off()
    drawn.text(0.1, 9.2, f"{sent.board.title}: wiring", fontweight="bold", va="center")
    drawn.set_aspect("equal")
    drawn.set_xlim(0, 21)
    drawn.set_ylim(-0.5, 9.6)
    _draw_panel(drawn, sent.board, values)
    _draw_led(drawn, sent.board, values)
    written.set_xlim(0, 1)
    written.set_ylim(0, 1)
    text = "\n".join(textwrap.fill(line, _LINE_LENGTH) for line in notes(sent))
    written.text(0, 1, text, va="top", ha="left", linespacing=1.35)
    return figure


def notes(sent: Transmission) -> list[str]:
    """Write what the circuit's values rest on, and what to beware of."""
    board, values = sent.board, wiring(sent.board)
    edge = SECOND.format(values.rise_time, 2)
    share = 100 * values.rise_time / float(sent.timing.period)
    return [
        f"A: {values.gate_resistor} Ω limit the current of the pin ({board.volts:g} V) into the "
        f"gate to {1e3 * board.volts / values.gate_resistor:.2g} mA; it may give "
        f"{1e3 * board.pin_current:g} mA. With the {1e9 * GATE_CAPACITANCE:g} nF that are assumed "
        f"of the gate its voltage rises within {edge}, {share:.2g} % of a chip. "
        f"{values.pull_down // 1000} kΩ keep the panel dark while the board starts.",
        f"MOSFET: n-channel, fully on at {board.volts:g} V. Panel: LEDs with resistors for a "
        "constant voltage. One with a driver or a capacitor inside does not follow the chips.",
        f"B, without a panel: {values.led_resistor} Ω give {1e3 * values.led_current:.2g} mA in an "
        f"LED of {LED_VOLTS:g} V (red, assumed; {1e3 * LED_CURRENT:g} mA aimed at).",
        "",
        f"Caution. {flicker_sentence(sent)} {EYES}",
    ]


def _draw_panel(axes: Axes, board: Board, values: Wiring) -> None:
    """Draw the paper's circuit: a MOSFET switches the panel."""
    axes.text(0.1, 7.9, "A: panel, switched as in the paper", va="center")
    symbols.box(axes, (0.1, 1.6), (3.2, 4.0), board.title.replace(" ", "\n", 1))
    axes.text(3.15, 4.35, board.pin, va="center", ha="right")
    axes.text(3.15, 2.1, board.ground, va="center", ha="right")
    symbols.wire(axes, (3.3, 4.0), (4.0, 4.0))
    symbols.resistor(axes, 5.0, 4.0, f"{values.gate_resistor} Ω")
    symbols.wire(axes, (6.0, 4.0), (7.6, 4.0))
    symbols.joint(axes, 6.7, 4.0)
    symbols.wire(axes, (6.7, 4.0), (6.7, 3.4))
    symbols.resistor(axes, 6.7, 2.4, f"{values.pull_down // 1000} kΩ", upright=True)
    symbols.transistor(axes, 8.6, 4.0, board.transistor)
    symbols.wire(axes, (9.1, 5.0), (9.1, 5.6))
    symbols.box(axes, (8.1, 5.6), (2.0, 1.3), "LED\npanel")
    symbols.wire(axes, (9.1, 6.9), (9.1, 7.5), (12.6, 7.5), (12.6, 5.4))
    symbols.box(axes, (11.6, 4.1), (2.0, 1.3), "12 V")
    axes.text(12.8, 5.6, "+", va="bottom")
    axes.text(12.8, 3.9, "-", va="top")
    # The board's ground, the MOSFET's source and the supply's minus are one wire.
    symbols.wire(axes, (3.3, 2.1), (4.0, 2.1), (4.0, 0.7), (12.6, 0.7), (12.6, 4.1))
    for x, top in ((6.7, 1.4), (9.1, 3.0)):
        symbols.wire(axes, (x, top), (x, 0.7))
        symbols.joint(axes, x, 0.7)
    symbols.wire(axes, (5.2, 0.7), (5.2, 0.3))
    symbols.joint(axes, 5.2, 0.7)
    symbols.ground(axes, 5.2, 0.3)


def _draw_led(axes: Axes, board: Board, values: Wiring) -> None:
    """Draw a single LED at the pin."""
    axes.text(15.2, 7.9, "B: a single LED", va="center")
    axes.text(15.2, 6.4, f"{board.pin} of the board", va="bottom", ha="left")
    symbols.wire(axes, (15.4, 6.2), (16.6, 6.2), (16.6, 5.9))
    symbols.resistor(axes, 16.6, 4.9, f"{values.led_resistor} Ω", upright=True)
    symbols.wire(axes, (16.6, 3.9), (16.6, 3.4))
    symbols.diode(axes, 16.6, 2.4, "LED")
    symbols.wire(axes, (16.6, 1.4), (16.6, 0.7))
    symbols.ground(axes, 16.6, 0.7)
    axes.text(17.3, 0.5, board.ground, va="center", ha="left")
