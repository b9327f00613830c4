"""What is on the page: one viewer a tab, and the status line above them.

The one rule: a view watches the outcome and never another view; its panes are built once.
"""
