"""Runs the gallery's examples, and makes a page, a notebook and figures of each.

An example is a Python file of cells in jupytext's percent format: cells of Markdown, the first of
which has the title, and cells of code. What a cell prints and draws stands below it on its page.
"""

import io
import re
import warnings
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import jupytext
import matplotlib as mpl
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

mpl.use("Agg")
from matplotlib import pyplot as plt

ROOT = Path(__file__).parents[3]
EXAMPLES = Path(__file__).parents[1] / "gallery"
DOTS_PER_INCH = 120


@dataclass
class Example:
    """An example that has been run."""

    name: str  # the file's, without its number and suffix
    source: str
    title: str = ""
    page: str = ""  # in Markdown
    notebook: str = ""  # the text of its file
    figures: dict[str, bytes] = field(default_factory=dict)  # PNG files by name
    names: dict[str, object] = field(default_factory=dict)  # the variables at its end


def paths() -> list[Path]:
    """List the files of the examples in the gallery's order."""
    return sorted(EXAMPLES.glob("*.py"))


def _name(path: Path) -> str:
    return re.sub(r"^\d+_", "", path.stem)


@cache
def run(path: Path) -> Example:
    """Run an example in the project's folder, once however often the site is built."""
    example = Example(_name(path), path.read_text(encoding="utf-8"))
    cells = jupytext.reads(example.source, fmt="py:percent")
    example.notebook = jupytext.writes(cells, fmt="ipynb")
    parts: list[str] = []
    for cell in cells.cells:
        parts += [cell.source] if cell.cell_type == "markdown" else _run_cell(cell.source, example)
    title, parts[0] = parts[0].split("\n", 1)
    example.title = title.removeprefix("# ")
    downloads = f"Download: [Python]({example.name}.py), [notebook]({example.name}.ipynb)"
    example.page = "\n\n".join([title, *parts, downloads]) + "\n"
    return example


def _run_cell(code: str, example: Example) -> list[str]:
    """Run a cell of code; return it with what it prints and draws, as Markdown."""
    printed = io.StringIO()
    with chdir(ROOT), redirect_stdout(printed), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*cannot be shown")
        exec(compile(code, example.name, "exec"), example.names)  # noqa: S102 - our own file
    parts = [f"```python\n{code}\n```"]
    if printed.getvalue():
        parts.append(f"```text\n{printed.getvalue().rstrip()}\n```")
    for name, content in _drawn(example):
        example.figures[name] = content
        parts.append(f"![{example.name.replace('_', ' ')}]({name})")
    return parts


def _drawn(example: Example) -> Iterator[tuple[str, bytes]]:
    """Return name and content of each figure that is open, and close it."""
    for number in plt.get_fignums():
        content = io.BytesIO()
        plt.figure(number).savefig(content, dpi=DOTS_PER_INCH)
        yield f"{example.name}-{len(example.figures) + 1}.png", content.getvalue()
    plt.close("all")


def contents(examples: list[Example]) -> str:
    """Return the gallery's first page: every example with its last figure."""
    lines = ["# Gallery", "", "Each example was run when this site was built.", ""]
    for example in examples:
        lines += [
            f"## [{example.title}]({example.name}.md)",
            "",
            f"[![{example.title}]({list(example.figures)[-1]})]({example.name}.md)",
            "",
        ]
    return "\n".join(lines)


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Enter the examples below the gallery in the navigation."""
    pages = ["gallery/index.md", *(f"gallery/{_name(path)}.md" for path in paths())]
    config.nav = [
        entry if "Gallery" not in entry else {"Gallery": pages} for entry in config.nav or []
    ]
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add pages, figures and files to download."""
    examples = [run(path) for path in paths()]
    made: dict[str, str | bytes] = {"index.md": contents(examples)}
    for example in examples:
        made[f"{example.name}.md"] = example.page
        made[f"{example.name}.py"] = example.source
        made[f"{example.name}.ipynb"] = example.notebook
        made |= example.figures
    for name, content in made.items():
        files.append(File.generated(config, f"gallery/{name}", content=content))
    return files
