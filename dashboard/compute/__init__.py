"""Solving off the event loop: the newest request wins, and sessions share what was solved."""
