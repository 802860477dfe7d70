#!/bin/sh
# Makes what a Windows computer without a network needs: "windows.sh DIST PYTHON" writes a zip with the wheel of the program, the
# wheels of everything it uses (for Windows, as the lock file has them), and install.cmd. Python 3.11 or newer must be there.
# It was made here and not run: no Windows was at hand.
set -eu

dist=$1 python=$2
wheel=$(ls "$dist"/amp_studio-*.whl)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
name=amp-studio-$(basename "$wheel" | cut -d- -f2)-windows
mkdir -p "$work/$name/wheels"
# Markers are about the computer that installs, and pip asks them of this one.
sed "s/ ; sys_platform == 'win32'//; s/ ; platform_python_implementation == 'CPython'//" requirements/run.lock >"$work/needed.txt"
"$python" -m pip download --quiet --disable-pip-version-check --only-binary :all: --no-deps --require-hashes --platform win_amd64 \
    --python-version 3.11 --implementation cp --abi cp311 --abi abi3 --abi none --dest "$work/$name/wheels" -r "$work/needed.txt"
cp "$wheel" "$work/$name/wheels"
printf '%s\r\n' '@echo off' 'rem Installs AMP Studio for this user, without the network.' 'setlocal' \
    'set TARGET=%LOCALAPPDATA%\AMP Studio' 'py -3.11 -m venv "%TARGET%" || exit /b 1' \
    '"%TARGET%\Scripts\python" -m pip install --no-index --find-links "%~dp0wheels" amp-studio || exit /b 1' \
    'echo Start it: "%TARGET%\Scripts\amp-studio.exe"' >"$work/$name/install.cmd"
(cd "$work" && python3 -m zipfile -c "$name.zip" "$name")
mv "$work/$name.zip" "$dist/"
printf '%s: %s MB\n' "$dist/$name.zip" "$(du -m "$dist/$name.zip" | cut -f1)"
