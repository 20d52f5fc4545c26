"""Recollect: a kiosk for studies in which a robot helps a person play Concentration.

The rooms, from the bottom: game, assistant, study, robot and store (which never meet), then ui, training and
analysis (which never meet), and cli, the front door. Imports go one way only; ``tests/test_walls.py`` holds the walls.
"""

__version__ = "0.1.0"


class BadInput(Exception):
    """Something that was handed to Recollect cannot be used; the message says what and where, in one sentence.

    At the command line it becomes that sentence and exit code 2. Nothing has been changed when it is raised.
    """
