#!/usr/bin/env bash
# Makes the image that lies over the guest's Debian: what is installed on a kiosk, two small packs, and this
# folder's guest/ for the tests.
#
#   guest_payload.sh BUILD PACKS OUT.squashfs    BUILD: a build folder; PACKS: a folder of *.fspack and words.fswords
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
build=$1 packs=$2 out=$3

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
chmod 755 "$tree"
for component in base kiosk; do
    DESTDIR=$tree cmake --install "$build" --component "$component" --strip >/dev/null
done
install -D -m 644 -t "$tree/var/lib/frustumscreen/packs" "$packs"/*.fspack
install -m 644 -t "$tree/var/lib/frustumscreen" "$packs/words.fswords"
mkdir -p "$tree/usr/lib/frustumscreen"
c++ -O1 -Wall -Wextra -shared -fPIC "$here/guest_hang.cpp" -o "$tree/usr/lib/frustumscreen/hang.so"
cp -R "$here/guest/." "$tree/"
rm -f "$out"
mksquashfs "$tree" "$out" -quiet -no-progress -noI -noD -noF -no-xattrs -all-root >/dev/null
