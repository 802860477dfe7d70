"""An emulated control with grblHAL or Grbl 1.1 firmware, to practise on and to break."""
