#!/bin/sh
# Packs the folder of the program: "pack.sh FOLDER DIST" writes an archive, and a package for Debian where
# dpkg-deb is. The package puts the folder below /opt, the command into the path, and the man page,
# the completions and the entry of the menu where a desktop looks for them.
set -eu

folder=$1 dist=$2
version=$("$folder/amp-studio" --version | awk '{print $NF}')
machine=$(uname -m)
name=amp-studio-$version-linux-$machine

# What is left when names for debuggers go; the libraries of numpy do not load afterwards.
find "$folder/_internal" -name '*.so*' -type f -not -path '*/numpy.libs/*' -exec strip --strip-unneeded {} + 2>/dev/null || true
# Qt has its own data of languages and asks ICU for nothing that this program does (no collation, no codecs), but
# its core is linked against ICU's 31 MB of data: ICU's own empty table (stubdata) is put in their place.
icu=$(find "$folder/_internal" -name 'libicudata.so.*' -type f)
if [ -n "$icu" ]; then
    number=${icu##*.}
    work=$(mktemp -d)
    cat >"$work/stub.s" <<END
    .section .rodata
    .globl icudt${number}_dat
    .balign 16
icudt${number}_dat:
    .short 32
    .byte 0xda, 0x27
    .short 20, 0
    .byte 0, 0, 2, 0
    .ascii "ToCP"
    .byte 1, 0, 0, 0, 0, 0, 0, 0
    .zero 16
    .section .note.GNU-stack, "", %progbits
END
    as -o "$work/stub.o" "$work/stub.s"
    ld -shared -soname "libicudata.so.$number" -o "$icu" "$work/stub.o"
    rm -r "$work"
fi
printf '%s: %s MB\n' "$folder" "$(du -sm "$folder" | cut -f1)"
tar -C "$(dirname "$folder")" -cJf "$dist/$name.tar.xz" "$(basename "$folder")"
printf '%s: %s MB\n' "$dist/$name.tar.xz" "$(du -m "$dist/$name.tar.xz" | cut -f1)"

command -v dpkg-deb >/dev/null || { echo "no dpkg-deb here: the package for Debian was not made"; exit 0; }
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/DEBIAN" "$root/opt" "$root/usr/bin" "$root/usr/share/applications" "$root/usr/share/man/man1" \
    "$root/usr/share/bash-completion/completions" "$root/usr/share/zsh/site-functions" "$root/usr/share/fish/vendor_completions.d"
cp -R "$folder" "$root/opt/amp-studio"
ln -s /opt/amp-studio/amp-studio "$root/usr/bin/amp-studio"
"$folder/amp-studio" man | gzip -9n >"$root/usr/share/man/man1/amp-studio.1.gz"
"$folder/amp-studio" completion bash >"$root/usr/share/bash-completion/completions/amp-studio"
"$folder/amp-studio" completion zsh >"$root/usr/share/zsh/site-functions/_amp-studio"
"$folder/amp-studio" completion fish >"$root/usr/share/fish/vendor_completions.d/amp-studio.fish"
cat >"$root/usr/share/applications/amp-studio.desktop" <<'END'
[Desktop Entry]
Type=Application
Name=AMP Studio
Comment=The numbered parameters that fit a CNC control or servo module to a machine
Exec=/opt/amp-studio/amp-studio ui %F
Categories=Engineering;
Terminal=false
END
cat >"$root/DEBIAN/control" <<END
Package: amp-studio
Version: $version
Architecture: $(dpkg --print-architecture)
Maintainer: AMP Studio contributors <none@localhost>
Installed-Size: $(du -sk "$root/opt" | cut -f1)
Depends: libc6 (>= $(ldd --version | awk 'NR == 1 {print $NF}')), zlib1g
Recommends: fonts-dejavu-core
Section: science
Priority: optional
Description: workbench for the parameters of CNC controls and servo modules
 Edits, checks, documents and exchanges the numbered parameters of a machine,
 and simulates what they do. It brings its own Python.
END
dpkg-deb --root-owner-group -Zxz --build "$root" "$dist/amp-studio_${version}_$(dpkg --print-architecture).deb" >/dev/null
printf '%s: %s MB\n' "$dist/amp-studio_${version}_$(dpkg --print-architecture).deb" "$(du -m "$dist"/amp-studio_"$version"_*.deb | cut -f1)"
