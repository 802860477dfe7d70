"""Prove that the folder of ``make bundle`` needs nothing but the C library and zlib: ``prove.py FOLDER``.

Every verb is asked for its help, and the work of a day is done: check, PDF, motion in a process apart, an
exchange with an emulated control, the window. As root this happens in a changed root that has the C library,
zlib and no shell, no Python and no fonts; else with an empty environment.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BARE = (
    "libc",
    "libm",
    "libdl",
    "libpthread",
    "librt",
    "libutil",
    "libresolv",
    "libnss_files",
    "libnss_dns",
    "libz",
)
"""What the smallest system has: the parts of glibc, of which no folder can bring its own, and zlib, by which
the folder's starter is unpacked.
"""
EXAMPLE = "/opt/amp-studio/_internal/amp_studio/examples/mill-1394/MILL_1394.amp"
DAY = (
    "new grblhal a.amp",
    f"validate {EXAMPLE} a.amp",
    "report a.amp -o a.pdf",
    "export a.amp -o a.settings",
    f"validate {EXAMPLE}",
    f"simulate {EXAMPLE} step --axis X",
    f"simulate {EXAMPLE} sweep --axis X -o map.svg --jobs 2",
    f"check {EXAMPLE}",
    "demo --terminal",
)


class Proof:
    """Runs the program of the folder far from everything."""

    def __init__(self, folder: Path, root: Path) -> None:
        self.root = root
        self.program = "/opt/amp-studio/amp-studio"
        shutil.copytree(folder, root / "opt/amp-studio", symlinks=True, copy_function=os.link)
        for name in ("tmp", "root", "lib64", "lib", "dev", "proc"):
            (root / name).mkdir(exist_ok=True)
        (root / "dev/null").touch()
        self.is_bare = os.geteuid() == 0
        if self.is_bare:
            self._bring_c_library()

    def _bring_c_library(self) -> None:
        """Copy the C library of this system and its loader."""
        listed = subprocess.run(
            ["ldd", str(self.root / "opt/amp-studio/amp-studio")], capture_output=True, text=True, check=True
        ).stdout
        libc = Path(next(line.split()[2] for line in listed.splitlines() if "libc.so" in line))
        for file in libc.parent.iterdir():
            if file.name.split(".so")[0].split("-")[0] in BARE and ".so" in file.name:
                shutil.copy(file, self.root / "lib" / file.name)
        loader = Path(next(line.split()[0] for line in listed.splitlines() if "ld-linux" in line))
        shutil.copy(loader, self.root / loader.relative_to("/"))

    def run(self, *arguments: str, patience_s: float = 600) -> tuple[int, str]:
        """Return the exit code and what was printed."""
        environment = {"HOME": "/root", "LD_LIBRARY_PATH": "/lib"}
        before = None
        command, where = [self.program, *arguments], "/root"
        if self.is_bare:
            before = self._go_inside
        else:
            environment = {"HOME": str(self.root / "root")}
            command, where = [f"{self.root}{self.program}", *arguments], str(self.root / "root")
        done = subprocess.run(
            command,
            env=environment,
            cwd=None if self.is_bare else where,
            preexec_fn=before,
            text=True,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=patience_s,
            check=False,
        )
        return done.returncode, done.stdout + done.stderr

    def _go_inside(self) -> None:
        os.chroot(self.root)
        os.chdir("/root")


def window_trouble(folder: Path, root: Path) -> str:
    """Return what is wrong with the window on this system, without a display: it must still be there after
    20 s.
    """
    example = f"{folder}/_internal/amp_studio/examples/mill-1394/MILL_1394.amp"
    environment = {"HOME": str(root / "tmp"), "QT_QPA_PLATFORM": "offscreen"}
    with subprocess.Popen(
        [folder / "amp-studio", example], env=environment, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            return f"ended with {process.wait(20)}: {process.communicate()[1][-1500:]}"
        except subprocess.TimeoutExpired:
            process.terminate()
            said = process.communicate()[1]
            return said if "Traceback" in said else ""


def main(folder: Path) -> int:
    """Print what fails; return 1 where something does."""
    failed = 0
    with tempfile.TemporaryDirectory(dir=folder.parent) as root:
        proof = Proof(folder, Path(root))
        print(
            "in a changed root with the C library and zlib alone"
            if proof.is_bare
            else "without an environment"
        )
        listed = proof.run("--help")[1]
        verbs = re.findall(r"^  ([a-z-]+) ", listed, re.MULTILINE)
        asked = [*([verb, "--help"] for verb in verbs), *(line.split() for line in DAY)]
        for arguments in asked:
            code, text = proof.run(*arguments)
            if code or "Traceback" in text:
                failed += 1
                print(f"FAILED {' '.join(arguments)}: {code}\n{text[-1500:]}")
        if trouble := window_trouble(folder, Path(root)):
            failed += 1
            print(f"FAILED the window: {trouble}")
        print(f"{len(asked) + 1 - failed} of {len(asked) + 1} runs succeed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
