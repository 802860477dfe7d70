"""Simulated motion, tuning, the measured machine and calibration."""
