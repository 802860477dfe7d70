"""The commands of the menus, each file one menu or one subject."""
