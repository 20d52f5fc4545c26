"""The command line, and the wiring of packages that do not import each other."""
