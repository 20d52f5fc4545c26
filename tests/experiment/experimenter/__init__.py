"""The booth's rules: who may do what, and when."""
