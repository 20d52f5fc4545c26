"""What can be told of a sitting from its events and nothing else: the screen, the export and the analysis all ask here."""
