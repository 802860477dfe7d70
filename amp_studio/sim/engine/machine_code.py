"""Machine code that numba made once on a machine, kept, and loaded by LLVM alone from then on.

numba takes 0.3 s to load, more than most runs compute, and nothing of it is needed to call what it has made:
a plain function over pointers and sizes, which asks for exp and sin of the C library and for nothing else.

What is kept lies where Python keeps its compiled modules, as numba's own does; who can write there
can change the program itself. Only where that cannot be written it lies in the user's cache.

How numba passes arguments (``CPUCallConv`` of its ``core/callconv.py``) is no promise of it, and LLVM alone
is not tried on every system. So new code is kept only once a process apart has loaded it and come to the
numbers of numba, bit for bit, for the first run that it was made for; else numba makes it in each process.
"""

from __future__ import annotations

import ctypes
import hashlib
import importlib.util
import json
import logging
import pickle
import subprocess
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, Literal

from amp_studio.child_process import child_command
from amp_studio.schema import cache_folder, read_cached, write_cached
from amp_studio.version import __version__

if TYPE_CHECKING:
    from types import FunctionType

    Make = Callable[[], tuple[FunctionType, dict[str, Any]]]
    """Returns a function as numba is to compile it, and the options for that."""

ArgumentKind = Literal["float64[::1]", "float64[:, ::1]", "int64", "float64"]
"""An argument: numbers in a row, rows of them, a whole number, a number."""
VECTOR: ArgumentKind = "float64[::1]"
ROWS: ArgumentKind = "float64[:, ::1]"
WHOLE: ArgumentKind = "int64"
NUMBER: ArgumentKind = "float64"
_DIMENSIONS = {VECTOR: 1, ROWS: 2}
_DONE, _NOTHING = 0, -2
"""What numba's code ends with: with a result, or without one."""
_log = logging.getLogger(__name__)


class MachineCode:
    """A function of machine code; its arrays are contiguous and of float64, and kept by who calls.

    ``result``: whether it returns a whole number, or nothing.
    """

    def __init__(self, name: str, code: bytes, kinds: Sequence[ArgumentKind], result: bool) -> None:
        from llvmlite import binding

        # The engine owns the code: it ends with this object.
        self._engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _target())
        self._engine.add_object_file(binding.ObjectFileRef.from_data(code))
        self._engine.finalize_object()
        types: list[Any] = [ctypes.c_void_p, ctypes.c_void_p]
        for kind in kinds:
            types += _types_of(kind)
        call = ctypes.CFUNCTYPE(ctypes.c_int32, *types)
        self._call = call(self._engine.get_function_address(name))
        self._kinds, self._result = tuple(kinds), result

    def __call__(self, *arguments: Any) -> int | None:
        """Call it. Raises TypeError for an array that it cannot read, RuntimeError where it ends in an
        error.
        """
        returned, error = ctypes.c_int64(), ctypes.c_void_p()
        given: list[Any] = [ctypes.addressof(returned), ctypes.addressof(error)]
        for kind, argument in zip(self._kinds, arguments, strict=True):
            dimensions = _DIMENSIONS.get(kind)
            if dimensions is None:
                given.append(argument)
            else:
                given += _array(argument, dimensions)
        ended = self._call(*given)
        if ended not in (_DONE, _NOTHING):
            raise RuntimeError(f"machine code ended with {ended}")
        return returned.value if self._result else None


class NewCode:
    """A function that numba has just made, and whose first call proves the code that is to be kept."""

    def __init__(self, name: str, kinds: Sequence[ArgumentKind], result: bool, function: Any) -> None:
        from llvmlite import binding

        (made,) = function.overloads.values()
        module = binding.parse_assembly(function.inspect_llvm(function.signatures[0]))
        self._code = made.fndesc.llvm_func_name, _target().emit_object(module)
        self._name, self._kinds, self._result, self._function = name, tuple(kinds), result, function
        self._is_tried = False

    def __call__(self, *arguments: Any) -> int | None:
        """Call it. Raises TypeError for an array that it cannot read."""
        before = None if self._is_tried else pickle.dumps((*self._code, self._kinds, self._result, arguments))
        returned: int | None = self._function(*arguments)
        if before is not None:
            self._is_tried = True
            if _apart(before) == _numbers(returned, arguments):
                _keep(self._name, self._code)
            else:
                _log.warning("%s is made again in each process: LLVM alone does not run it here", self._name)
        return returned


def _apart(question: bytes) -> bytes:
    """Return what a process apart comes to; empty where it was ended, or took too long."""
    command = child_command(__name__, "try_code")
    with suppress(OSError, subprocess.SubprocessError):
        return subprocess.run(command, input=question, capture_output=True, timeout=60, check=True).stdout
    return b""


def try_code(asked: BinaryIO, out: BinaryIO) -> None:
    """Call machine code once, in the process apart, and write what it returned and its arrays."""
    *code, arguments = pickle.load(asked)  # noqa: S301  # the program itself has written it
    out.write(_numbers(MachineCode(*code)(*arguments), arguments))


def _numbers(returned: int | None, arguments: Sequence[Any]) -> bytes:
    """Return every bit of what a call returned and left in its arrays."""
    arrays = (each.tobytes() for each in arguments if hasattr(each, "tobytes"))
    return b"".join((str(returned).encode(), *arrays))


def machine_code(
    name: str, kinds: Sequence[ArgumentKind], result: bool, make: Make
) -> MachineCode | NewCode | None:
    """Return the machine code of a name: what was kept under it, or what numba makes of the function that
    ``make`` returns, with the options of numba; None where numba is missing or cannot be imported.

    The name is another one for any other function.
    """
    if not _makers():
        return None
    if (kept := _read(name)) is not None:
        return MachineCode(*kept, kinds, result)
    try:
        import numba
    except ImportError:  # with the numpy that is here
        return None
    function, options = make()
    signature = f"{'int64' if result else 'void'}({', '.join(kinds)})"
    return NewCode(name, kinds, result, numba.njit(signature, **options)(function))


def _target() -> Any:
    """Return this processor as LLVM makes code for it; an engine takes it for its own and ends it."""
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    triple, processor, features = _processor()
    return binding.Target.from_triple(triple).create_target_machine(cpu=processor, features=features, opt=3)


@lru_cache(maxsize=1)
def _processor() -> tuple[str, str, str]:
    """Return system, processor and its features, as LLVM names them."""
    from llvmlite import binding

    return (
        binding.get_process_triple(),
        binding.get_host_cpu_name(),
        binding.get_host_cpu_features().flatten(),
    )


def _makers() -> str:
    """Return what makes the code, numba and LLVM, by their versions; empty where one is missing."""
    versions = []
    for library in ("numba", "llvmlite"):
        found = importlib.util.find_spec(library)
        if found is None or found.origin is None:
            return ""
        version = Path(found.origin).with_name("_version.py")
        # A bundle has no sources, and its libraries are those of this version of the program.
        versions.append(version.read_bytes() if version.exists() else __version__.encode())
    return hashlib.sha256(b"".join(versions)).hexdigest()


def _places(name: str) -> tuple[Path, Path]:
    """Return where code is kept: the name of the file is that of the function, the versions, and the
    processor.
    """
    made_for = " ".join((_makers(), *_processor()))
    file = f"{name}-{hashlib.sha256(made_for.encode()).hexdigest()[:24]}.json"
    beside = Path(importlib.util.cache_from_source(__file__)).parent
    return beside / file, cache_folder() / file


def _read(name: str) -> tuple[str, bytes] | None:
    for path in _places(name):
        kept = read_cached(path)
        if kept is not None:
            own, code = json.loads(kept)
            return own, bytes.fromhex(code)
    return None


def _keep(name: str, made: tuple[str, bytes]) -> None:
    kept = json.dumps([made[0], made[1].hex()]).encode()
    any(write_cached(path, kept, name) for path in _places(name))  # the first that can be written


def _types_of(kind: ArgumentKind) -> list[Any]:
    """Return how numba passes an argument: an array as two owners, its size, the bytes of a number, where it
    begins, and for each dimension its length and the bytes from one to the next.
    """
    if kind in _DIMENSIONS:
        owners, sizes = [ctypes.c_void_p] * 2, [ctypes.c_int64] * 2
        return [*owners, *sizes, ctypes.c_void_p, *[ctypes.c_int64] * (2 * _DIMENSIONS[kind])]
    return [ctypes.c_int64 if kind == WHOLE else ctypes.c_double]


def _array(array: Any, dimensions: int) -> list[Any]:
    if array.dtype.char != "d" or array.ndim != dimensions:
        raise TypeError("machine code reads contiguous arrays of float64")
    # Refused by ctypes where it is not contiguous. NumPy's own way to the address takes six times as long.
    begin = ctypes.addressof(ctypes.c_double.from_buffer(array)) if array.size else None
    return [None, None, array.size, 8, begin, *array.shape, *array.strides]
