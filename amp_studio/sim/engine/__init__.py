"""The inner loop over flat arrays, plain or compiled: machine, plant,
profile and the kernel that steps them under a law.
"""
