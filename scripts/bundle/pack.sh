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
