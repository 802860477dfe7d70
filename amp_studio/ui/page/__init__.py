"""The page of one file: group list, steps, table, findings and detail panel together."""
