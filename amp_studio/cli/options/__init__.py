"""The options of every verb, a module for each group of verbs. No room is imported, because help loads none."""
