"""Printed documentation, and parameters and findings in words."""

from .describe import definition, facts, finding_json, finding_text, help_parts, one_line, page_of, range_text

__all__ = ["definition", "facts", "finding_json", "finding_text", "help_parts", "one_line", "page_of", "range_text"]
