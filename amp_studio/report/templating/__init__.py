"""Templates of documents, also those of a project, which are run as the text of another author: bounded,
and in a sandbox.
"""
