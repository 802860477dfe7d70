"""What every folder of the window is built on: the theme, tasks in the background, questions,
the open file as the window sees it.
"""
