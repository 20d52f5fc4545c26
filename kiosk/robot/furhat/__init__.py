"""A Furhat as a device, over either of its interfaces; only kiosk/robot/kinds.py looks in here."""
