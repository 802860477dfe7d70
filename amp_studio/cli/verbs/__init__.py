"""The verbs, a file each, in a folder for each kind (``registry.GROUPS``)."""
