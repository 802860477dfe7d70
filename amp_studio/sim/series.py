"""The types of numpy's arrays in the simulator."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Series = npt.NDArray[np.float64]
"""A column of a trace, or frequencies."""
Response = npt.NDArray[np.complex128]
"""A frequency response, or poles."""
