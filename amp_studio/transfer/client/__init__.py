"""What puts files into controls and compares them: exchanges, the copies kept of what a control contained."""
