"""An emulated NUM control: behind a gateway, or with its parameter table on a serial line."""
