"""What the verbs about a machine in motion share: its check and its errors in words and drawn."""
