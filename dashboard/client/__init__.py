"""What passes between server and browser."""
