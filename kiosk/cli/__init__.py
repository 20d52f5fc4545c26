"""The front door: the command line and the wiring, nothing else. Only here do rooms that never meet come together."""
