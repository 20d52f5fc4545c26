"""Embodiments that speak: what a body is, and the voice in a process of its own. No windows, no database."""

LOUDNESS_MS = 40
"""Length of one step of a sentence's loudness, in ms: 25 steps a second, the rate at which a mouth moves."""
