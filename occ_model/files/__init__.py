"""Reading of files within bounds, complete or no writing, and the files of the package."""
