"""What stands between the network and the sessions: opening, bounds, processes, who may come in."""
