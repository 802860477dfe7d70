"""A machine on its way to another control: the questions, what is less safe, and each parameter once."""
