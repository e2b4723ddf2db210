"""What the README copies from the code is what the code says."""

import re
from pathlib import Path

from occ_model.commands.listing import parameter_table

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def test_the_table_of_parameters_is_that_of_the_declarations() -> None:
    """``occ-model parameters --markdown`` prints it anew."""
    assert parameter_table() in README


def test_every_picture_and_file_that_is_named_is_there() -> None:
    root = Path(__file__).parents[2]
    named = re.findall(r"\]\(((?!https?:)[^)#]+)\)", README)
    named += re.findall(r"python3? ((?:tests|resources)/[\w/.]+\.py)", README)
    assert len(named) > 8
    assert [name for name in named if not (root / name).exists()] == []


def test_the_headless_example_runs_and_is_short() -> None:
    block = re.search(r"```python\n(import occ_model as occ\n.*?)```", README, re.DOTALL)
    assert block is not None
    lines = [line for line in block[1].splitlines() if line.strip()]
    assert len(lines) <= 6
    names: dict[str, object] = {}
    exec(compile(block[1], "README", "exec"), names)
    assert names["result"].code == 718  # type: ignore[attr-defined]
