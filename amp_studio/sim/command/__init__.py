"""The command of an axis: ramps, moves and stops as profiles of closed pieces; the figures of homing,
jogging and limits.
"""
