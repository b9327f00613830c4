"""What is on the page: one viewer a tab, and the status line above them.

A view watches the outcome and never another view; its panes are built once.
"""
