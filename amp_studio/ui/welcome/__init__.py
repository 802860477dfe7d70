"""The page without a file: recent files, examples, known controls."""
