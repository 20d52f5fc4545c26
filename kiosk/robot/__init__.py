"""Bodies that speak: what a body is, and the voice in a process of its own. No windows, no database."""
