"""The tab Decide, a module for each of its questions."""
