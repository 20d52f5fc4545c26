"""Rehearsals: a simulated visitor at the real window, pictures of what it saw, and the pulse of the interface."""
