"""Where a build begins: ``recollect``, with an environment that every program it starts can live in."""

import os

from kiosk.cli.main import main

# What we start of ourselves begins like any other start, and finds the build's libraries by itself.
os.environ["PYINSTALLER_RESET_ENVIRONMENT"] = "1"
if "LD_LIBRARY_PATH" in os.environ:
    # They are for ourselves only: aplay and git would stumble over them.
    before = os.environ.pop("LD_LIBRARY_PATH_ORIG", "")
    del os.environ["LD_LIBRARY_PATH"]
    if before:
        os.environ["LD_LIBRARY_PATH"] = before

main()
