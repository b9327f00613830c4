"""Tests that drive a browser: one browser and one server for each process that runs some of them."""
