#!/usr/bin/env bash
# Makes the files that --test adds to the initrd: QEMU's guest agent, the programs that a test calls in the guest, and the script that
# lays both over the root. An image for kiosks has none of them, and they cannot be added to it: the initrd is part of the signed kernel
# image.
#
#   test_agent.sh DEBIAN ROOT OUT.cpio    DEBIAN: the packages' files; ROOT: the image's; OUT: appended to the initrd by the caller
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
debian=$1 root=$2 out=$3
tree=$(mktemp -d -p "$(dirname "$out")")
trap 'rm -rf "$tree"' EXIT
over=$tree/extra/over
mkdir -p "$over"

"$here/lean.py" "$over" "$tree/kept" --from "$debian" --from "$debian/unpacked" --files "$here/test_agent/files.list"
rm "$tree/kept" "$over"/{bin,sbin,lib,lib64}
cp "$debian"/unpacked/lib/modules/*/kernel/drivers/char/virtio_console.ko "$tree/extra/"
(cd "$over" && find . -type f) | while read -r file; do # libraries that the root has
    [[ ! -e $root/$file ]] || rm "$over/$file"
done
cp -R "$here/test_agent/over/." "$over/"
install -m 644 "$here/test_agent/lay_over.sh" "$tree/extra/"
find "$tree" -exec touch --no-dereference --date="@$SOURCE_DATE_EPOCH" {} +
(cd "$tree" && find . -print0 | LC_ALL=C sort -z | cpio --quiet --reproducible --null --owner=0:0 -o -H newc) |
    zstd -q -3 --single-thread >"$out"
