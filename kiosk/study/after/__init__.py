"""What can be told of a sitting from its events alone: the screen, the export and the analysis all ask here."""
