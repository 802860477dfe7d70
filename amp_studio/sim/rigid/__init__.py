"""The rigid axis of the 9/PC with its own kernel; it goes when the law of the 9/PC runs over the shared one."""
