"""The only package with windows: it shows what a session asks for, and reports what the visitor does.

It has no rules of the study, and no other package uses Qt.
"""
