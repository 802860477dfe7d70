"""The preview of the report, and printing."""
