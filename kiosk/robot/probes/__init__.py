"""Looks at what speaks: sound, voices, the robot. Nothing is heard, and a robot's settings stay as they are."""
