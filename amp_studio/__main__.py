"""``python -m amp_studio``."""

from amp_studio.cli import main

main()
