"""AMP Studio: the workbench for the numbered parameters that fit a control to a machine."""

__version__ = "0.1.0"
