"""Templates of documents, also those of a project, which are run as the text of somebody else: bounded,
and in a sandbox.
"""
