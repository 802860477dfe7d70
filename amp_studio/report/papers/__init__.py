"""Papers that are no report: differences, machines side by side, forms, check lists, sheets to key in."""
