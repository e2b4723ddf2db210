"""The commands of ``occ-model``, one module each."""
