"""Many variations of one axis: what is varied, the batch of runs,
the cores or the cluster that it is spread over, and what it shows.
"""
