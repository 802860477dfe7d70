"""What the verbs at a control share: its ends, several controls at once, a job that watches for drift."""
