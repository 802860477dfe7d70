"""Every format in every order, for machines plain, odd and empty."""

from __future__ import annotations

import shutil
import subprocess
import time
from datetime import datetime
from pathlib import Path

import pytest

from amp_studio.files import Header, ParameterFile, SaveFault, new_file
from amp_studio.report import FORMATS, SORTS, build_report, write_report
from amp_studio.report.model import Sort
from amp_studio.schema import Value, family_ids, load_schema

from .conftest import Machine  # type: ignore[import-not-found]
