"""The window as it stands at a booth: over a whole screen, left by nobody, awake all day. No screen's content."""
