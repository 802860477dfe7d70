"""An axis under its law: one run over a profile, or stepped in its own time, homed,
and behind an emulated control.
"""
