"""What the verbs of a file share: values by their marks, and a new file like another one."""
