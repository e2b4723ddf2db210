"""The commands of ``occ-model``, in a module each."""
