"""Offline: simulated players, the rewards, and tabular Q-learning, which freezes a table into a policy file.

Nothing here runs while a visitor plays, and nothing here draws: the package knows the game and the assistant only.
What is random follows from a seed alone, so a policy can be made again to the last digit, compiled or not.
"""
