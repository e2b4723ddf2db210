"""A Raspberry Pi Pico in which MicroPython runs: stand-ins for the modules of its state machine.

Each instruction takes one cycle and its delay, as the RP2040's data sheet says.
"""

import sys
from collections.abc import Callable
from contextlib import suppress
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

DIVIDER = 0x502000C8
TURNS = 3  # how often the endless loop of a program may fill the queue
_EDGES = 7  # of the pin, after which a program without a loop ends


class _Ended(Exception):  # noqa: N818 - no error
    """The loop has run often enough."""


class Instruction:
    """An instruction of the state machine, with the delay that brackets add."""

    def __init__(self, name: str, *words: Any) -> None:
        self.name, self.words, self.delay = name, words, 0

    def __getitem__(self, delay: int) -> "Instruction":
        assert 0 <= delay <= 31
        self.delay = delay
        return self


class SimulatedPico:
    """What a program has done: instructions, words sent, registers, clock, and edges of the pin."""

    def __init__(self) -> None:
        self.program: list[Instruction] = []
        self.settings: dict[str, object] = {}
        self.words: list[int] = []
        self.registers: dict[int, int] = {}
        self.edges: list[tuple[int, int]] = []
        self.clock, self.pin, self._turns = 0, None, 0
        self._is_running = False
        self._labels: dict[str, int] = {}
        self._first = self._end = 0

    def run(self, source: str) -> "SimulatedPico":
        """Run a program for some turns of its loop."""
        machine, rp2 = ModuleType("machine"), ModuleType("rp2")
        vars(machine).update(freq=self.set_clock, mem32=self.registers, Pin=lambda number: number)
        pio = SimpleNamespace(OUT_LOW="low", SHIFT_LEFT="left", JOIN_TX="tx")
        vars(rp2).update(PIO=pio, asm_pio=self._asm_pio, StateMachine=self.make_state_machine)
        with pytest.MonkeyPatch.context() as patch, suppress(_Ended):
            patch.setitem(sys.modules, "machine", machine)
            patch.setitem(sys.modules, "rp2", rp2)
            exec(compile(source, "main.py", "exec"), {"__name__": "__main__"})
        assert self.edges or self._turns == TURNS, "the program does not end"
        return self

    def set_clock(self, hertz: int) -> None:
        self.clock = hertz

    def _asm_pio(self, **settings: object) -> Callable[[Callable[[], None]], object]:
        self.settings = settings
        return self._assemble

    def _assemble(self, program: Callable[[], None]) -> object:
        def adder(name: str) -> Callable[..., Instruction]:
            def add(*words: object) -> Instruction:
                self.program.append(Instruction(name, *words))
                return self.program[-1]

            return add

        names: dict[str, object] = {
            name: adder(name) for name in ("out", "pull", "mov", "set", "jmp")
        }
        names |= {
            "label": lambda name: self._labels.update({name: len(self.program)}),
            "wrap_target": lambda: setattr(self, "_first", len(self.program)),
            "wrap": lambda: setattr(self, "_end", len(self.program)),
        }
        names |= {register: register for register in ("x", "isr", "osr", "pins", "x_dec")}
        program.__globals__.update(names)
        program()
        for name in names:
            del program.__globals__[name]
        return self.program

    def make_state_machine(self, number: int, program: object, **pins: Any) -> SimpleNamespace:
        assert number == 0, "the divider's register is that of state machine 0"
        assert program is self.program
        (self.pin,) = pins.values()
        return SimpleNamespace(active=self._start, put=self._put)

    def _put(self, words: Any) -> None:
        if isinstance(words, int):
            assert 0 <= words < 2**32
            self.words.append(words)
            return
        assert words.itemsize == 4
        assert self._is_running
        self.words += words.tolist()
        self._turns += 1
        if self._turns == TURNS:
            raise _Ended

    def _start(self, on: bool) -> None:
        assert on
        if self.program[0].name == "out":  # of the words that are put later
            assert DIVIDER in self.registers, "the divider is set before it runs"
            self._is_running = True
            return
        registers, queue = {"x": 0, "isr": 0, "osr": 0}, [*self.words]
        place = cycle = 0
        while len(self.edges) < _EDGES:
            instruction = self.program[place]
            words, place = instruction.words, place + 1
            if instruction.name == "pull":
                registers["osr"] = queue.pop(0)
            elif instruction.name == "mov":
                registers[words[0]] = registers[words[1]]
            elif instruction.name == "set":
                self.edges.append((cycle, int(words[1])))
            elif self._labels[words[1]] == place - 1:  # a jump to itself until x is 0: all at once
                cycle += registers["x"]
                registers["x"] = 2**32 - 1
            cycle += 1 + instruction.delay
            place = self._first if place == self._end else place
