"""Pictures of a trace: panels, curves and marks, and their SVG."""
