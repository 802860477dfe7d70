"""An emulated rack with one module, whose registers are alive."""
