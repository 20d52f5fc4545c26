"""Recollect: a kiosk for studies in which a robot helps a person play Concentration.

The rooms, from the bottom: game, assistant, study, robot and store (which never meet), then ui, training and
analysis (which never meet), and cli, the front door; keeping stands beside them. Imports go one way only;
``tests/test_walls.py`` holds the walls.
"""

import sys

__version__ = "0.1.0"


class BadInput(Exception):
    """Something that was handed to Recollect cannot be used; each sentence says what and where.

    Mostly there is one; a file that is checked as a whole has one for everything that is wrong with it. At the command
    line they become one line each and exit code 2. Nothing has been changed when it is raised.
    """

    def __init__(self, *sentences: str) -> None:
        """Say what is wrong."""
        super().__init__(*sentences)
        self.sentences = sentences

    def __str__(self) -> str:
        """The sentences, one per line."""
        return "\n".join(self.sentences)


def program(*arguments: str) -> tuple[str, ...]:
    """The command that runs ``recollect`` with these arguments in another process, from a checkout or a build."""
    return (sys.executable, *(() if getattr(sys, "frozen", False) else ("-m", "kiosk")), *arguments)
