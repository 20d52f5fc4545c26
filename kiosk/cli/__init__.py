"""The front door: the command line and the wiring, nothing else. Only here may rooms that never meet be put together."""
