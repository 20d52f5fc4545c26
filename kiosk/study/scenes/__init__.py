"""What each stage does: how it begins, which events it takes, and what they lead to. None knows the next."""
