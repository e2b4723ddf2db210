"""Write everything needed to blink a scene: sketch, waveform, scene, and wiring diagram."""

import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from schemdraw import Drawing, elements

from occ_model.boards.board import (
    GATE_CAPACITANCE,
    LED_CURRENT,
    LED_VOLTS,
    PULL_DOWN,
    TransmitterBoard,
)
from occ_model.boards.sketch import file_names, write_sketch
from occ_model.boards.transmission import EYES, LampTransmission, Transmission, flicker_sentence
from occ_model.boards.waveform_files import COLUMNS, edge_rows, vcd_text, wav_bytes
from occ_model.errors import OutputError
from occ_model.figures.drawing import figure_bytes, house_style, table_text
from occ_model.files.writing import write_folder
from occ_model.scene.provenance import Provenance
from occ_model.scene.units import SECOND


def write_transmitter_files(folder: Path, transmission: Transmission) -> tuple[list[Path], str]:
    """Write the files into a folder; the scene has the frequency that is actually sent.

    Return their paths and a sentence why there is no WAV file, empty if there is one.
    """
    contents, no_wav_reason = _contents(folder, transmission)
    write_folder(folder, contents)
    return [folder / name for name in contents], no_wav_reason


def _contents(folder: Path, transmission: Transmission) -> tuple[dict[str, bytes], str]:
    sketch, table, vcd, wav, pdf, svg, png, scene = file_names(folder, transmission.board)
    contents = {
        sketch: write_sketch(transmission).encode("utf-8"),
        table: table_text(
            (transmission.part, *COLUMNS), edge_rows(transmission), provenance(transmission)
        ).encode("utf-8"),
        vcd: vcd_text(transmission).encode("ascii"),
        pdf: wiring_bytes(transmission, "pdf"),
        svg: wiring_bytes(transmission, "svg"),
        png: wiring_bytes(transmission, "png"),
        scene: transmission.sent_scene.to_toml().encode("utf-8"),
    }
    try:
        contents[wav] = wav_bytes(transmission)
    except OutputError as error:
        return contents, str(error)
    return contents, ""


def wiring_bytes(transmission: Transmission, format_name: str) -> bytes:
    with house_style():
        return figure_bytes(wiring_figure(transmission), format_name, provenance(transmission))


def provenance(transmission: Transmission) -> Provenance:
    return Provenance(f"Transmitter: {transmission.board.title}", {"sent": transmission.sent_scene})


_SIZE = (7.6, 6.0)  # in inches
_TEXT = 8  # size of the circuits' texts, in points
_LINE_LENGTH = 116  # characters of a line of the text below the diagram


def wiring_figure(transmission: Transmission) -> Figure:
    """Draw the circuit; to be called in :func:`occ_model.figures.drawing.house_style`."""
    figure = Figure(figsize=_SIZE)
    figure.suptitle(f"{transmission.board.title}: wiring", fontweight="bold")
    places = figure.subplot_mosaic("AAB;TTT", height_ratios=(3.4, 2.6))
    text_axes = places["T"]
    for axes in places.values():
        axes.set_axis_off()
    places["A"].set_title("A: panel, switched as in the paper")
    _draw_panel(places["A"], transmission.board)
    places["B"].set_title("B: a single LED")
    _draw_led(places["B"], transmission.board)
    text_axes.set(xlim=(0, 1), ylim=(0, 1))
    text = "\n".join(textwrap.fill(line, _LINE_LENGTH) for line in circuit_notes(transmission))
    text_axes.text(0, 1, text, va="top", ha="left", linespacing=1.35)
    return figure


def circuit_notes(transmission: Transmission) -> list[str]:
    """Explain the values of the circuit, and warn of flicker and bright light."""
    board = transmission.board
    edge = SECOND.format(board.rise_time, 2)
    if isinstance(transmission, LampTransmission):
        duration, part, light = transmission.timing.lit_time, "the time lit", "light"
    else:
        duration, part, light = transmission.timing.period, "a chip", "chips"
    fraction = 100 * board.rise_time / float(duration)
    return [
        f"A: {board.gate_resistor} Ω limit the current from the pin ({board.volts:g} V) into the "
        f"gate to {1e3 * board.volts / board.gate_resistor:.2g} mA; it may give "
        f"{1e3 * board.pin_current:g} mA. With the assumed {1e9 * GATE_CAPACITANCE:g} nF of the "
        f"gate, its voltage rises within {edge}, {fraction:.2g} % of {part}. "
        f"{PULL_DOWN // 1000} kΩ keep the panel dark while the board starts.",
        f"MOSFET: n-channel, fully on at {board.volts:g} V. Panel: LEDs with resistors for a "
        f"constant voltage. One with a driver or a capacitor inside does not follow the {light}.",
        f"B, without a panel: {board.led_resistor} Ω give {1e3 * board.led_current:.2g} mA in an "
        f"LED of {LED_VOLTS:g} V (assumed, red); the target is {1e3 * LED_CURRENT:g} mA.",
        "",
        f"Caution. {flicker_sentence(transmission)} {EYES}",
    ]


def _draw_panel(axes: Axes, board: TransmitterBoard) -> None:
    """Draw the paper's circuit: a MOSFET switches the panel."""
    with _circuit(axes) as drawing:
        pins = [
            elements.IcPin(board.ground, side="right", anchorname="ground", lblsize=_TEXT),
            elements.IcPin(board.pin, side="right", anchorname="out", lblsize=_TEXT),
        ]
        name = board.title.replace(" ", "\n", 1)
        chip = drawing.add(elements.Ic(pins=pins, size=(3.4, 3.6), label=name))
        drawing.add(elements.RBox().at(chip.out).right(3.4).label(f"{board.gate_resistor} Ω"))
        gate = drawing.add(elements.Dot())
        pull_down = drawing.add(
            elements.RBox().down(2.6).label(f"{PULL_DOWN // 1000} kΩ", loc="bottom")
        )
        drawing.add(elements.Dot())
        drawing.add(elements.Ground())
        mosfet = elements.NMos().right().anchor("gate").label(board.transistor, "right")
        drawing.add(mosfet.at((gate.center.x + 1.0, gate.center.y)))
        drawing.add(elements.Line().at(gate.center).to(mosfet.gate))
        ends = [elements.IcPin(side=side, anchorname=side) for side in ("top", "bottom")]
        panel = elements.Ic(pins=ends, size=(2.0, 1.4), label="LED\npanel").anchor("bottom")
        drawing.add(panel.at(mosfet.drain))
        drawing.add(elements.Line().at(panel.top).right(3.4))
        drawing.add(elements.Battery().toy(pull_down.end).reverse().label("12 V", "bottom"))
        # The board's ground, the MOSFET's source and the supply's minus are connected.
        drawing.add(elements.Line().tox(mosfet.source))
        drawing.add(elements.Dot())
        drawing.add(elements.Line().tox(pull_down.end))
        drawing.add(elements.Line().at(mosfet.source).toy(pull_down.end))
        drawing.add(elements.Wire("|-").at(chip.ground).to(pull_down.end))


def _draw_led(axes: Axes, board: TransmitterBoard) -> None:
    with _circuit(axes) as drawing:
        drawing.add(elements.Dot(open=True).label(board.pin, "right"))
        drawing.add(elements.RBox().down(2.6).label(f"{board.led_resistor} Ω", loc="bottom"))
        drawing.add(elements.LED().down(2.0).label("LED", loc="bottom"))
        drawing.add(elements.Ground().label(board.ground, "right"))


@contextmanager
def _circuit(axes: Axes) -> Iterator[Drawing]:
    drawing = Drawing(canvas=axes)
    drawing.config(fontsize=_TEXT, lw=1.2, font=rcParams["font.family"][0])
    yield drawing
    drawing.draw(show=False)
    axes.set_aspect("equal", adjustable="datalim")
