"""The folder of a LinuxCNC as a control: its configuration with what it includes, and what a program that
runs with it uses.
"""
