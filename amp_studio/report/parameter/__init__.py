"""One parameter in words and as data: its facts, numbers, printed tables, and why it is as it is."""
