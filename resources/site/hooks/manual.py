"""Fits the manual's pages, which the window shows as well, into the site."""

import re
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from occ_gui.help.pages import heading_id

PICTURES = Path(__file__).parents[2] / "pictures"


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Name the headings as the window's help does, so that the same links reach them."""
    config.mdx_configs["toc"]["slugify"] = lambda text, _separator: heading_id(text)
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pictures, which have a folder of their own beside that of the pages."""
    for picture in sorted(PICTURES.iterdir()):
        uri = f"pictures/{picture.name}"
        files.append(File.generated(config, uri, abs_src_path=str(picture)))
    return files


def on_page_content(html: str, **_others: Any) -> str:
    """Turn what reStructuredText has in docstrings, roles and double colons, into plain text."""
    return re.sub(r":\w+:(?=<code>)", "", html).replace("::</p>", ":</p>")


def on_page_markdown(markdown: str, **_others: Any) -> str:
    """Point to the pictures' place in the site."""
    return markdown.replace("](../pictures/", "](pictures/")
