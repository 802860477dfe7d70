#!/bin/sh
# Makes the checkout ready: "bootstrap.sh run" for the program, "bootstrap.sh dev" for the program and its checks.
#
# Done once, and again only when a lock file or pyproject.toml has changed:
#   1. a virtual environment in .venv
#   2. the exact packages of requirements/<run|dev>.lock, each checked against its hash
#   3. amp-studio itself, installed so that it runs from this checkout
#   4. the system libraries Qt needs (Linux; installed when this runs as root on Debian or Ubuntu, else named)
# PYTHON=/path/to/python chooses another interpreter than the first suitable one of the path.
set -eu

cd "$(dirname "$0")/.."
here=$(pwd -P)
python=.venv/bin/python
unset PYTHONHOME PYTHONPATH PIP_USER PIP_TARGET PIP_PREFIX PIP_REQUIRE_VIRTUALENV || true

stop() {
    printf 'amp-studio: %s\n' "$1" >&2
    exit 1
}

note() {
    printf 'amp-studio: %s\n' "$1" >&2
}

# Whether this may install system packages by itself.
may_install() {
    [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1
}

# Installs system packages; where one name is unknown to this system, the others all the same.
install_system() {
    note "installing system packages: $*"
    install_quietly "$@" 2>/dev/null && return
    apt-get update -qq >/dev/null || return
    install_quietly "$@" && return
    for package in "$@"; do
        install_quietly "$package" 2>/dev/null || note "$package could not be installed"
    done
}

install_quietly() {
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# -- Python and the virtual environment ------------------------------------------------------------

# From 3.11, and not newer than the compiled packages of the lock.
suitable() {
    "$1" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))' >/dev/null 2>&1
}

find_python() {
    for candidate in ${PYTHON:-python3 python3.14 python3.13 python3.12 python3.11}; do
        if suitable "$candidate"; then
            command -v "$candidate"
            return
        fi
    done
    [ -z "${PYTHON:-}" ] || stop "PYTHON=$PYTHON is not found, does not start, or is none of Python 3.11, 3.12, 3.13 and 3.14"
    stop "Python 3.11, 3.12, 3.13 or 3.14 is needed and was not found; on Debian 12, Ubuntu 24.04 or newer: sudo apt-get install python3 python3-venv"
}

# A virtual environment knows its own place by name, so one that was copied or whose Python is gone is made anew.
environment_works() {
    suitable "$python" && grep -qsF "$here/.venv" .venv/bin/activate
}

make_environment() {
    base=$(find_python)
    version=$("$base" -c 'import sys; print("python%d.%d" % sys.version_info[:2])')
    rm -rf .venv
    note "making a virtual environment in .venv with $version"
    if ! "$base" -c 'import venv, ensurepip' >/dev/null 2>&1; then
        # Debian keeps the seed of a virtual environment in a package of its own.
        if may_install; then
            install_system "$version-venv" || stop "$version-venv could not be installed; run: apt-get update && apt-get install $version-venv"
        elif "$base" -c 'import venv, pip; assert tuple(map(int, pip.__version__.split(".")[:2])) >= (22, 3)' >/dev/null 2>&1; then
            "$base" -m venv --without-pip .venv
            printf '%s\n' "$base" >.venv/pip-from
            return
        else
            stop "a virtual environment cannot be made without the package $version-venv; run: sudo apt-get install $version-venv"
        fi
    fi
    "$base" -m venv .venv || stop "a virtual environment could not be made in $here/.venv (see above)"
}

# pip of the environment, or the system's pip working on it where the environment could not be given one.
pip() {
    if [ -f .venv/pip-from ]; then
        "$(cat .venv/pip-from)" -m pip --python "$python" "$@"
    else
        "$python" -m pip "$@"
    fi
}

# -- packages ---------------------------------------------------------------------------------------

# What the environment was made from; a changed line means that there is something to do.
recipe() {
    cat "requirements/$1.lock" pyproject.toml
}

# Development includes everything the program needs.
ready() {
    for kind in "$1" dev; do
        recipe "$kind" | cmp -s - ".venv/ready-$kind" && return
    done
    return 1
}

install_packages() {
    rm -f .venv/ready-* .venv/qt-works
    note "getting the packages of requirements/$1.lock (over 200 MB the first time, which can take minutes)"
    pip install --quiet --disable-pip-version-check --no-input --no-warn-script-location \
        --only-binary :all: --require-hashes --no-deps -r "requirements/$1.lock" ||
        stop "the Python packages could not be installed (see above); is the network there?"
    pip install --quiet --disable-pip-version-check --no-input --no-warn-script-location \
        --no-index --no-deps --no-build-isolation --editable . ||
        stop "amp-studio could not be installed into .venv (see above)"
    # From its own place and in ASCII: Python reads this in the encoding of the locale, which may not have a name
    # above the checkout.
    for packages in .venv/lib/python3*/site-packages; do
        echo ../../../.. >"$packages/_amp_studio.pth"
    done
    recipe "$1" >".venv/ready-$1"
}

# -- the libraries Qt needs from the system ---------------------------------------------------------

# What starts Qt at all, and what opens a window on X11 (Wayland needs nothing more).
qt_core="lib/libQt6Widgets.so.6 lib/libQt6DBus.so.6 lib/libQt6Network.so.6 lib/libQt6OpenGLWidgets.so.6
    lib/libQt6PrintSupport.so.6 lib/libQt6Svg.so.6 plugins/platforms/libqoffscreen.so"
qt_window=plugins/platforms/libqxcb.so

# The system libraries that these files of PySide6 need and the system does not have.
missing_libraries() {
    folder=$("$python" -c 'import importlib.util as u; print(u.find_spec("PySide6").submodule_search_locations[0])')/Qt
    for file in $1; do
        ldd "$folder/$file" 2>/dev/null || true
    done | awk '/not found/ && $1 !~ /^libQt6/ {print $1}' | sort -u
}

# The Debian package of a library: its name and its version, which is how Debian names library packages.
package_of() {
    case $1 in
    libglib-2.0.so.0 | libgthread-2.0.so.0) echo libglib2.0-0 ;;
    libbrotli*) echo libbrotli1 ;;
    libz.so.1) echo zlib1g ;;
    *) echo "$1" | sed -E 's/([0-9])\.so\./\1-/; s/\.so\.//' | tr 'A-Z_' 'a-z-' ;;
    esac
}

packages_of() {
    for library in $1; do
        package_of "$library"
    done | sort -u | tr '\n' ' ' | sed 's/ $//'
}

qt_starts() {
    QT_QPA_PLATFORM=offscreen "$python" -c '
from PySide6 import QtGui, QtNetwork, QtPrintSupport, QtSvg, QtWidgets
QtWidgets.QApplication([])'
}

check_qt() {
    [ "$(uname -s)" = Linux ] || return 0
    always=$(missing_libraries "$qt_core")
    window=$(missing_libraries "$qt_window")
    if [ -n "$always$window" ] && may_install; then
        # shellcheck disable=SC2046 # a list of words
        install_system $(packages_of "$always $window") || true
        always=$(missing_libraries "$qt_core")
        window=$(missing_libraries "$qt_window")
    fi
    if [ -n "$always" ]; then
        say="Qt needs system libraries that are missing; run: sudo apt-get install $(packages_of "$always $window")"
        [ "$1" = dev ] || [ -n "$display" ] || { note "$say" && return 1; } # the demonstration can do without a window
        stop "$say"
    fi
    if [ -n "$window" ] && [ "$display" = x11 ]; then
        stop "the window needs system libraries that are missing; run: sudo apt-get install $(packages_of "$window")"
    fi
    qt_starts || stop "Qt cannot be started (see above)"
}

# ---------------------------------------------------------------------------------------------------

case ${1:-} in
run | dev) ;;
*) stop "say 'run' or 'dev'" ;;
esac

display=${WAYLAND_DISPLAY:+wayland}
display=${display:-${DISPLAY:+x11}}

environment_works || make_environment
ready "$1" || install_packages "$1"
# Looked at again for a window: the environment may have been made where there was no display.
if [ ! -f .venv/qt-works ] || { [ "$1" = run ] && [ "$display" = x11 ]; }; then
    if check_qt "$1"; then
        touch .venv/qt-works
    fi
fi
