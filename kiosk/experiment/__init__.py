"""Who plays, in which condition, in what order: the middle of the program.

``Session.handle(event) -> Outcome(events, effects)`` is all of it. There is no clock, no chance, no window, no socket
and no database here: time comes with the events, chance from one seed. So a stored list of events, handled again, gives
the same outcomes again, and that one property is the test, the recovery, the replay and the audit of a study.
"""
