"""Offline: tests, effect sizes, figures and the report. Only here may matplotlib and scipy be used."""
