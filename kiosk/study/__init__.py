"""Read, check and import study files."""
