"""The CEL engine without its command line.

``import cel`` also imports the package's own command-line program (typer,
prompt_toolkit: 0.2 s of every start), so the compiled module is loaded alone.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Any


def _engine() -> ModuleType:
    package = importlib.util.find_spec("cel")
    for folder in (package.submodule_search_locations or ()) if package else ():
        for library in sorted(Path(folder).glob("cel.*")):
            if library.suffix in (".so", ".pyd"):
                spec = importlib.util.spec_from_file_location("cel.cel", library)
                if spec and spec.loader:
                    module = importlib.util.module_from_spec(spec)
                    sys.modules.setdefault("cel.cel", module)
                    spec.loader.exec_module(module)
                    return module
    return importlib.import_module("cel")


_module = _engine()
Program = Any
compile_expression = _module.compile
Context = _module.Context
