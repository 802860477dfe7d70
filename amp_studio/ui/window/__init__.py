"""The main window without its commands: tabs, docks, tool bar, status bar, user settings."""
