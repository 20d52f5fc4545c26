"""Looks at what shows: screens, the desktop around them, the drawing. Each in a process of its own: Qt may end it."""
