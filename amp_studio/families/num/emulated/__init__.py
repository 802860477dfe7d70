"""An emulated NUM control that loads, unloads and verifies its parameter table over a serial line."""
