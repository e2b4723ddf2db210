"""The ESP32's sketch, compiled with a stand-in for its driver: the symbols are the packet."""

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import occ_model as occ
from occ_model.boards.esp32 import ESP32
from occ_model.boards.sketch import write_sketch
from occ_model.boards.transmission import Transmission, prepare_transmission

PAPER = occ.load_preset("phone-68us")

SCENES = {
    "paper": PAPER.replace(switching_frequency=14.7e3),
    "odd number of chips": PAPER.replace(pattern="1101000"),
    "slow": PAPER.replace(switching_frequency=80e6 / (7 * 32_003)),
    "fast": PAPER.replace(switching_frequency=1e6),
    "long": PAPER.replace(payload="text:" + "Photograph me. " * 30, line_code="4b6b"),
}

every_scene = pytest.mark.parametrize("name", SCENES)

_STUBS = Path(__file__).with_name("esp32_stubs.h")


def sent_by(name: str) -> Transmission:
    return prepare_transmission(SCENES[name], ESP32)


@every_scene
def test_the_table_is_the_packet(name: str) -> None:
    sent = sent_by(name)
    source = write_sketch(sent)
    (table,) = re.findall(r"PACKET\[\] = \{([^}]*)\}", source)
    octets = [int(octet, 16) for octet in re.findall("0x([0-9A-F]{2})", table)]
    (count,) = re.findall(r"CHIPS = (\d+);", source)
    chips = np.unpackbits(np.array(octets, dtype=np.uint8))[: int(count)]
    np.testing.assert_array_equal(chips, sent.chips)
    (clock,) = re.findall(r"TICKS_PER_SECOND = (\d+);", source)
    assert int(clock) * sent.timing.prescaler == ESP32.clock


@pytest.mark.compilers
@pytest.mark.parametrize(
    "name",
    ["odd number of chips"]
    + [pytest.param(one, marks=pytest.mark.whole) for one in SCENES if "odd" not in one],
)
def test_the_driver_gets_the_packet_repeatedly(name: str, tmp_path: Path) -> None:
    if shutil.which("g++") is None:
        pytest.skip("the sketch of the ESP32 cannot be compiled here; missing: g++")
    sent = sent_by(name)
    clock, levels, durations = run_sketch(write_sketch(sent), 2 * len(sent.chips) + 64, tmp_path)
    assert len(levels) > 4 * len(sent.chips)
    np.testing.assert_array_equal(levels, np.resize(sent.chips, len(levels)))
    assert set(durations) == {sent.timing.count}
    assert clock * sent.timing.prescaler == ESP32.clock


def run_sketch(source: str, symbols: int, folder: Path) -> tuple[int, list[int], list[int]]:
    """Compile and run a sketch; return its clock in Hz, and the levels and durations of chips."""
    (folder / "driver").mkdir()
    for name in ("rmt_tx.h", "rmt_encoder.h"):
        (folder / "driver" / name).write_text(f'#include "{_STUBS}"\n')
    main = folder / "main.cpp"
    main.write_text(f"{source}\nint main() {{ setup(); loop(); }}\n")
    program = folder / "sketch"
    built = subprocess.run(
        ["g++", "-std=gnu++17", "-Wall", "-Wextra", "-Werror", "-Wno-missing-field-initializers",
         f"-I{folder}", f"-DTEST_SYMBOLS={symbols}", main, "-o", program],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert built.returncode == 0, built.stderr
    done = subprocess.run([program], capture_output=True, text=True, check=True)
    first, *pairs = done.stdout.splitlines()
    levels, durations = zip(*(map(int, pair.split()) for pair in pairs), strict=True)
    return int(first), list(levels), list(durations)
