"""The data set for publishing: what is stored, as tables in which every column is declared once and described."""
