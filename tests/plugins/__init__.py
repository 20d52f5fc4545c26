"""Three packages of a lab that adds to Recollect, and what installs them beside it."""
