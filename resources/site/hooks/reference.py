"""Makes the reference: the public names from their docstrings, the commands from their help."""

from inspect import unwrap

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

import occ_model
from occ_model.commands.command_line import commands_of, make_parser

GROUPS = {
    "scene": "Scenes and presets",
    "transmitter": "Sending",
    "boards": "Boards that blink",
    "camera": "Exposure and pixel values",
    "effects": "The plan",
    "simulation": "Simulation",
    "receiver": "Decoding",
    "room": "Rooms",
    "photo": "Photos",
    "video": "Films",
    "study": "Studies",
    "results": "Results",
    "errors": "Errors",
}
"""The headings of the public names, by the folder or module in which they are defined."""


def python_page() -> str:
    """Return the page of all public names, as instructions for mkdocstrings."""
    lines = ["# Python", "", occ_model.__doc__ or "", ""]
    places = public_places()
    for folder, title in GROUPS.items():
        here = sorted(name for name, place in places.items() if place.split(".")[1] == folder)
        if here:
            lines += [f"## {title}", ""]
        for name in here:
            lines += [f"::: {places[name]}.{name}", "    options: {heading_level: 3}", ""]
    return "\n".join(lines)


def public_places() -> dict[str, str]:
    """Return the module of each public class and function, by name."""
    names = [name for name in occ_model.__all__ if not name.startswith("_")]
    return {name: unwrap(getattr(occ_model, name)).__module__ for name in names}


def command_page() -> str:
    """Return the page of all commands with their help."""
    lines = ["# Command line", ""]
    for name, parser in commands_of(make_parser()).items():
        lines += [f"## occ-model {name}", "", "```text", parser.format_help().rstrip(), "```", ""]
    return "\n".join(lines)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add both pages."""
    for name, content in (("python", python_page()), ("command-line", command_page())):
        files.append(File.generated(config, f"reference/{name}.md", content=content))
    return files
