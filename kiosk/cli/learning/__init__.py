"""The commands of the learning layer, and the evidence for what its documents claim."""
