"""Boards blink a lamp: the timer's best setting, the program that has it, and its waveform."""

import re
import shutil
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from model.boards.simulated_pico import SimulatedPico
from model.boards.test_esp32 import run_sketch

import occ_model as occ
from occ_model.boards.arduino import UNO
from occ_model.boards.board import TransmitterBoard
from occ_model.boards.chip_table import frequency_lines
from occ_model.boards.esp32 import ESP32
from occ_model.boards.pico import PICO
from occ_model.boards.sketch import BOARDS, write_sketch
from occ_model.boards.transmission import (
    LampTransmission,
    flicker_sentence,
    prepare_transmission,
)
from occ_model.boards.waveform_files import choose_wav_timing, wav_bytes

PAPER = occ.load_preset("phone-68us").replace(light="lamp")
FLASHES = PAPER.replace(light="pulses")

SCENES = {
    "dimmed": PAPER.replace(lamp_frequency=239.0, duty=0.3),
    "fast": PAPER.replace(lamp_frequency=100e3, duty=0.9),
    "slow": PAPER.replace(lamp_frequency=0.5, duty=0.01),
    "flashes": FLASHES.replace(pulse_frequency=60.0, pulse_length=500e-6),
}

every_board = pytest.mark.parametrize("board", BOARDS.values(), ids=lambda board: board.name)
every_scene = pytest.mark.parametrize("name", SCENES)

frequencies = st.floats(0.3, 400e3)
duties = st.floats(0.001, 0.999)


def send(scene: occ.Scene, board: TransmitterBoard) -> LampTransmission:
    sent = prepare_transmission(scene, board)
    assert isinstance(sent, LampTransmission)
    return sent


def lamp_of(board: TransmitterBoard, frequency: float, duty: float) -> LampTransmission:
    return send(PAPER.replace(lamp_frequency=frequency, duty=duty), board)


@settings(max_examples=25, deadline=None)
@given(frequency=frequencies, duty=duties)
def test_no_registers_of_the_arduino_come_nearer(frequency: float, duty: float) -> None:
    """All settings of f = f_clk / (N (TOP + 1)), and for the best all compare values."""
    found = lamp_of(UNO, frequency, duty).timing
    counts = np.arange(4, 65_537)
    best = None
    for prescaler in (1, 8, 64, 256, 1024):
        errors = np.abs(16e6 / (prescaler * counts) / frequency - 1.0)
        for count in counts[np.argsort(errors)[:3]].tolist():  # the exact best is among them
            made = Fraction(16_000_000, prescaler * count)
            off = abs(made / Fraction(frequency) - 1)
            lit = np.arange(1, count)
            least = Fraction(duty) * count
            near = int(lit[np.abs(lit - float(least)).argmin()])
            apart = abs(Fraction(near) - least) / count
            best = min(best or (off, apart, prescaler), (off, apart, prescaler))
    asked = abs(found.duty - Fraction(duty))
    assert (abs(found.error_ppm) / 10**6, asked, found.prescaler) == best


@settings(max_examples=25, deadline=None)
@given(board=st.sampled_from([ESP32, PICO]), frequency=frequencies, duty=duties)
def test_no_whole_cycles_and_no_whole_pwm_dividers_come_nearer(
    board: TransmitterBoard, frequency: float, duty: float
) -> None:
    found, asked = lamp_of(board, frequency, duty).timing, Fraction(frequency)
    assert found.prescaler == 1

    def error(cycles: int) -> Fraction:
        return abs(Fraction(board.clock, cycles) / asked - 1)

    best = error(found.cycles)
    least = board.lamp_timer.least_count
    assert all(best <= error(found.cycles + n) for n in (-1, 1) if found.cycles + n >= least)
    # f = f_sys / ((TOP + 1) DIV) of the RP2040, and 80 MHz / (DIV 2^bits) of the LED controller.
    dividers = np.arange(1, 256) if board is PICO else np.arange(1, 1024)
    tops = np.arange(1, 65_537) if board is PICO else 2 ** np.arange(1, 21)
    if board is PICO:
        tops = np.unique(np.concatenate([
            np.clip(board.clock / (dividers * frequency) + n, 1, 65_536).astype(int)
            for n in (0, 1)
        ]))  # fmt: skip
    cycles = np.unique(np.outer(dividers, tops))
    near = cycles[np.abs(board.clock / cycles / frequency - 1.0).argsort()[:3]]
    assert all(best <= error(int(each)) for each in near if each >= least)
    parts = np.arange(-2, 3) + found.lit_count
    allowed = board.lamp_timer.least_part
    parts = np.clip(parts, allowed, found.count - allowed)
    offs = [abs(Fraction(int(part), found.count) - Fraction(duty)) for part in parts]
    assert abs(found.duty - Fraction(duty)) == min(offs)


@every_board
def test_a_flash_keeps_its_length(board: TransmitterBoard) -> None:
    sent = send(FLASHES.replace(pulse_frequency=59.9, pulse_length=250e-6), board)
    assert abs(float(sent.timing.lit_time) - 250e-6) <= sent.timing.prescaler / board.clock / 2
    assert sent.sent_values.keys() == {"pulse_frequency", "pulse_length"}


@every_scene
def test_the_arduinos_registers_give_what_is_stated(name: str) -> None:
    sent = send(SCENES[name], UNO)
    source = write_sketch(sent)
    (selected,) = re.findall(r"CLOCK_SELECT = (.*);", source)
    bits = sum(1 << int(bit) for bit in re.findall(r"_BV\(CS1(\d)\)", selected))
    prescaler = {1: 1, 2: 8, 3: 64, 4: 256, 5: 1024}[bits]  # data sheet, table 16-5
    top, compare = (
        eval(re.findall(rf"{word} = ([\d\- ]+);", source)[0]) for word in ("TOP", "COMPARE")
    )
    assert 3 <= top <= 0xFFFF
    assert 0 <= compare < top
    assert Fraction(16_000_000, prescaler * (top + 1)) == sent.timing.frequency
    assert Fraction(compare + 1, top + 1) == sent.timing.duty
    # OCR1A takes effect at once only outside of PWM; ICR1 is writable only within.
    order = [source.index(word) for word in ("OCR1A =", "_BV(WGM11);", "_BV(WGM12);", "ICR1 =")]
    assert order == sorted(order)


@pytest.mark.compilers
@every_scene
def test_the_esp32_gets_the_lamps_cycles_repeatedly(name: str, tmp_path: Path) -> None:
    if shutil.which("g++") is None:
        pytest.skip("the sketch of the ESP32 cannot be compiled here; missing: g++")
    sent = send(SCENES[name], ESP32)
    symbols = 2 * (sent.timing.cycles // 0x4000 + 4)
    clock, levels, durations = run_sketch(write_sketch(sent), symbols, tmp_path)
    assert clock == ESP32.clock
    assert min(durations) >= 9
    signal = np.array(levels)
    ends = np.flatnonzero(np.diff(signal)) + 1
    runs = np.add.reduceat(np.array(durations), [0, *ends.tolist()])[:-1]
    assert len(runs) >= 2
    lit = sent.timing.lit_cycles
    np.testing.assert_array_equal(runs, np.resize([lit, sent.timing.cycles - lit], len(runs)))


@every_scene
def test_the_picos_program_takes_the_cycles_that_are_stated(name: str) -> None:
    sent = send(SCENES[name], PICO)
    pico = SimulatedPico().run(write_sketch(sent))
    cycles, levels = zip(*pico.edges, strict=True)
    assert levels == (1, 0, 1, 0, 1, 0, 1)
    lit = sent.timing.lit_cycles
    assert np.diff(cycles).tolist() == 3 * [lit, sent.timing.cycles - lit]
    assert (pico.clock, f"GP{pico.pin}") == (PICO.clock, PICO.pin)


@pytest.mark.parametrize(("changes", "sentence"), [
    ({"light": "mains"}, "light is mains; allowed on Arduino Uno: code, lamp or pulses, since a pin"
     " is either on or off."),
    ({"light": "waveform"}, "light is waveform; allowed on Arduino Uno: code, lamp or pulses, since"
     " a pin is either on or off."),
    ({"depth": 0.5}, "depth is 50 %; allowed on Arduino Uno: 100 %, since a pin is either on or"
     " off."),
    ({"duty": 1.0}, "duty is 100 %; allowed on Arduino Uno: more than 0 % and less than 100 %:"
     " others are steady light."),
    ({"light": "pulses", "pulse_frequency": 2e3}, "pulse_length is 500 µs; allowed on Arduino Uno:"
     " below 500 µs: others are steady light."),
])  # fmt: skip
def test_light_that_a_pin_cannot_send_is_refused(changes: dict[str, str], sentence: str) -> None:
    with pytest.raises(occ.ParameterError) as refused:
        send(PAPER.replace(**changes), UNO)
    assert str(refused.value) == sentence


def test_frequency_duty_and_flicker_are_stated() -> None:
    sent = send(SCENES["dimmed"], UNO)
    assert frequency_lines(sent) == [
        "Frequency: 239.005736 Hz, +24 ppm from the 239 Hz asked:",
        "a period lasts 66,944 cycles of the 16 MHz clock, which may be off by up to 5,000 ppm.",
        "It is lit for 20,080 of them: duty cycle 29.9952199 %, for the 30 % asked.",
    ]
    assert "at which the lamp blinks; its longest time without an edge is 2.929 ms" in (
        flicker_sentence(sent)
    )
    assert flicker_sentence(send(SCENES["flashes"], UNO)).count("seizures") == 1
    exact = send(PAPER.replace(lamp_frequency=1e3, duty=0.25), UNO)
    assert " ".join(frequency_lines(exact)).count("as asked") == 2


@every_board
def test_a_wav_file_holds_whole_periods(board: TransmitterBoard) -> None:
    sent = send(SCENES["dimmed"], board)
    timing = choose_wav_timing(sent)
    samples = np.frombuffer(wav_bytes(sent)[44:], dtype=np.uint8)  # after the header
    periods = samples.reshape(-1, timing.samples)
    assert (periods == periods[0]).all()
    lit = int((periods[0] == 255).sum())
    assert (periods[0][:lit] == 255).all()
    assert abs(Fraction(lit, timing.samples) - sent.timing.duty) <= Fraction(1, 2 * timing.samples)
    assert len(samples) >= timing.sample_rate
