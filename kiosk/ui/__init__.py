"""The only room with windows: it shows what the study commands and reports what the visitor does.

Rules live elsewhere. Everything Qt is in here, and nothing of Qt is anywhere else.
"""
