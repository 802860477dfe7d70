"""Text formats of the 57C422B: AutoMax BASIC tasks and register tables."""
