"""Text formats of AcroMill: ACR command scripts and ballscrew files."""
