"""What one session holds, as plain parameters: inputs, history, pinned designs, results."""
