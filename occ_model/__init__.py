"""A model of optical camera communication: a blinking panel, a rolling shutter, a receiver.

Everything here works without a window. A scene is a value; the functions take it and give arrays::

    import occ_model as occ

    scene = occ.load_preset("phone-136us").replace(switching_frequency=10e3, distance=1.2)
    frame = occ.render(scene)
    result = occ.decode(frame.image, scene)
"""

import lazy_loader

# The module of each public name is imported at its first use: Ctrl-C and ``--help`` need no numpy.
_load, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    value = _load(name)
    if type(value) is type(__getattr__):  # a function
        from occ_model.argument_kinds import checked

        value = checked(value)
    globals()[name] = value
    return value
