"""Whether what a study declares can be run: everything that its file names, read and held against each other."""
