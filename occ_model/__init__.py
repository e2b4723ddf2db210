"""A model of optical camera communication: a blinking panel, a rolling shutter, a receiver.

Everything here works without a window. A scene is a value; the functions take it and give arrays::

    import occ_model as occ

    scene = occ.load_preset("phone-136us").replace(switching_frequency=10e3, distance=1.2)
    frame = occ.render(scene)
    result = occ.decode(frame.image, scene)
"""

import ast
import importlib
import pkgutil

# The public names stand in a stub, which type checkers read, too. The module of each is imported at
# its first use: Ctrl-C and ``--help`` need no numpy.
_MODULES = {
    alias.name: f"{__name__}.{statement.module}"
    for statement in ast.parse(pkgutil.get_data(__name__, "__init__.pyi") or b"").body
    if isinstance(statement, ast.ImportFrom)
    for alias in statement.names
}

__all__ = sorted(_MODULES)


def __getattr__(name: str) -> object:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(_MODULES[name]), name)
    if type(value) is type(__getattr__):  # a function
        from occ_model.argument_kinds import check_arguments

        value = check_arguments(value)
    globals()[name] = value
    return value


def __dir__() -> set[str]:
    return {*globals(), *__all__}
