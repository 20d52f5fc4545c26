"""The tests mirror the packages and read as sentences."""
