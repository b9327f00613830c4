"""Lessons, and the explanations that the Learn tab draws."""
