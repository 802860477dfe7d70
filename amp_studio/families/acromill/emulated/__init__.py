"""An emulated ACR card that is spoken to through its terminal."""
