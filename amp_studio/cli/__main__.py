"""``python -m amp_studio.cli``."""

from . import main

main()
