"""Equations as text: in symbols, in numbers, and their results."""

import re
from collections.abc import Iterable, Sequence

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QFrame, QTextBrowser

from occ_model.results.teaching import Equation, Term

HIGHLIGHT_MS = 1500  # milliseconds for which a term is marked after one of its parameters changes

_MARK = "background-color:#F7D774; color:#000000; font-weight:600; text-decoration:underline;"
"""Style of marked terms, with weight and underline so that it does not depend on colour alone."""

_SCRIPTS = re.compile(r"(<su[bp]>.*?</su[bp]>)")
_SYMBOL = re.compile(r"[A-Za-zγ]+")  # noqa: RUF001 - the equation's own letter

_BASE = re.compile(r"[A-Za-z]+(?=<sub>)")

_LEAST_HEIGHT = 80


class EquationText(QTextBrowser):
    """Shows equations; terms whose parameters have just changed are marked for a moment."""

    def __init__(self) -> None:
        super().__init__()
        self._equations: tuple[Equation, ...] = ()
        self.setAccessibleName("Equations with their current numbers")
        self.setToolTip(
            "Terms that depend on the latest change are marked and underlined for a moment."
        )
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setMinimumHeight(_LEAST_HEIGHT)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.document().setDocumentMargin(4)
        self._mark_timer = QTimer(self, singleShot=True)
        self._mark_timer.setInterval(HIGHLIGHT_MS)
        self._mark_timer.timeout.connect(lambda: self._write(frozenset()))

    def show_equations(self, equations: Sequence[Equation], changed: frozenset[str]) -> None:
        self._equations = tuple(equations)
        self._mark_timer.stop()
        self._write(changed)
        if changed:
            self._mark_timer.start()

    def _write(self, changed: frozenset[str]) -> None:
        bar = self.verticalScrollBar()
        position = bar.value()
        self.setHtml(
            "".join(self._write_paragraphs(equation, changed) for equation in self._equations)
        )
        bar.setValue(position)  # setHtml scrolls to the top

    def _write_paragraphs(self, equation: Equation, changed: frozenset[str]) -> str:
        symbols = _join_terms(((_set_italics(t.text), t) for t in equation.symbols), changed)
        numbers = _join_terms(((_set_base_italics(t.text), t) for t in equation.numbers), changed)
        source = equation.source
        if source.startswith("("):
            source = f"equation {source}"
        # A sentence that says why a result is undefined is not set as a value.
        sign = "" if equation.result.startswith("undefined") else "= "
        meaning = _set_base_italics(equation.meaning)
        return (
            f"<p style='margin:0'>{meaning} <small>[{source}]</small></p>"
            f"<p style='margin:1px 0 0 14px'>= {symbols}</p>"
            f"<p style='margin:1px 0 0 14px'>= {numbers}</p>"
            f"<p style='margin:1px 0 9px 14px'><b>{sign}{equation.result}</b></p>"
        )


def _set_italics(text: str) -> str:
    """Set the letters of quantities in italics, but not their indices and exponents."""
    parts = _SCRIPTS.split(text)
    return "".join(
        part if _SCRIPTS.fullmatch(part) else _SYMBOL.sub(r"<i>\g<0></i>", part) for part in parts
    )


def _set_base_italics(text: str) -> str:
    """Set only letters with an index in italics, as the rest of the text is words or numbers."""
    return _BASE.sub(r"<i>\g<0></i>", text)


def _join_terms(terms: Iterable[tuple[str, Term]], changed: frozenset[str]) -> str:
    text, joins_next = "", True
    for html, term in terms:
        if not (joins_next or html.startswith(")")):
            text += " "
        is_marked = bool(changed.intersection(term.parameters))
        text += f"<span style='{_MARK}'>{html}</span>" if is_marked else html
        joins_next = html.endswith("(")
    return text
