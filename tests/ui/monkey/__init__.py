"""A monkey in front of the kiosk: input without sense, robots that fail, and kills."""
