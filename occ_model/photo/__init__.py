"""Photos: read them, find their stripes and lamps, and match them with a scene.

Where the sentence on a constant names no measurement and no derivation, its value was chosen.
"""
