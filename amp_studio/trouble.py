"""A fault of the program itself: one line for the person,
the details in a file for the developer who mends it.
"""

from __future__ import annotations

from pathlib import Path


def log_folder() -> Path:
    """Return the folder of the details of faults; it may not exist yet."""
    import platformdirs  # for what hardly ever happens

    return Path(platformdirs.user_log_dir("amp-studio"))


def last_details() -> str:
    """Return the details of the last fault; nothing where there was none, or they cannot be read."""
    try:
        return (log_folder() / "trouble.txt").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def keep_details(error: BaseException) -> str:
    """Keep the traceback of an unforeseen error and return one sentence that names it and the place."""
    message = f"this should not have happened ({type(error).__name__}: {error})"
    try:
        import traceback  # likewise

        place = log_folder() / "trouble.txt"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text("".join(traceback.format_exception(error)), encoding="utf-8")
    except OSError:
        return message
    return f"{message}; the details are in {place}"
