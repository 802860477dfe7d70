"""Speaking to a NUM control: its parameter table over a serial line, with a person at its keys."""
