"""Where the files that come with the package are."""

from pathlib import Path


def resource_path(*parts: str) -> Path:
    """Give the path of a file that comes with the package.

    An installed package carries its resources inside; a checkout has them beside the packages.
    """
    package = Path(__file__).parent
    installed = package / "resources"
    root = installed if installed.is_dir() else package.parent / "resources"
    return root.joinpath(*parts)
