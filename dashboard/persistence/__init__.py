"""What outlives a session: link, study, exported files."""
