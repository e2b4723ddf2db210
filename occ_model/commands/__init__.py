"""The commands of ``occ-model``, one file each: ``add_to`` says what it takes and does."""
