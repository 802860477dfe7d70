"""Keeps linear algebra on one thread; imported before numpy.

Its matrices have some ten to a hundred rows: threads win nothing there, and on a busy machine they wait for
each other (0.7 s became 5 s). What the environment already sets stays.
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
