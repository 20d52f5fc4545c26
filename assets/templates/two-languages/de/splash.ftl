### What stands on the screen while the kiosk is started again, in every language at once.

splash-line = Gleich geht es weiter
