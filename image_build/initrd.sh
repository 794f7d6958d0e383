#!/usr/bin/env bash
# Makes the initrd: busybox, dmsetup, e2fsck, chattr, the drivers marked `initrd` in modules.list, and initrd/init.
#
#   initrd.sh DEBIAN ROOT LEVEL OUT    DEBIAN: the packages' files; ROOT: the image's root, with the modules;
#                                      LEVEL: compression level of zstd
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
debian=$1 root=$2 level=$3 out=$4
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

version=$(ls "$root/usr/lib/modules")
mkdir -p "$tree"/{bin,lib64,lib/x86_64-linux-gnu,"lib/modules/$version"}
cp "$debian/unpacked/bin/busybox" "$tree/bin/"
libraries() { # FILE: the names of the libraries that a program or a library links
    readelf --dynamic "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'
}
add() {
    local name
    cp -L "$1" "$2"
    for name in $(libraries "$1"); do
        [[ -e $tree/lib/x86_64-linux-gnu/$name ]] || add "$debian/usr/lib/x86_64-linux-gnu/$name" "$tree/lib/x86_64-linux-gnu/$name"
    done
}
add "$debian/usr/sbin/dmsetup" "$tree/bin/dmsetup"
add "$debian/usr/sbin/e2fsck" "$tree/bin/e2fsck"
add "$debian/usr/bin/chattr" "$tree/bin/chattr"
cp -L "$debian/usr/lib64/ld-linux-x86-64.so.2" "$tree/lib64/"
install -m 755 "$here/initrd/init" "$tree/init"

while read -r module; do
    install -D -m 644 "$root/usr/lib/modules/$version/$module" "$tree/lib/modules/$version/$module"
done <"$root/usr/lib/modules/$version/initrd"
cp "$root/usr/lib/modules/$version"/modules.{order,builtin,builtin.modinfo} "$tree/lib/modules/$version/"
depmod --basedir "$tree" "$version"
# Modules that no device requests
printf '%s\n' squashfs dm_verity sha256_ssse3 ext4 crc32c_generic crc32c_intel overlay efivarfs sd_mod >"$tree/modules"

# An empty keymap in the format of busybox's loadkmap: a byte for each of 256 maps, 1 if the map follows (here those that the kernel has:
# plain, Shift, AltGr, Ctrl, Shift+Ctrl, Alt, Ctrl+Alt); then for each of these maps 128 keys without a function (K_HOLE, 0x0200).
{
    printf bkeymap
    for map in {0..255}; do
        case $map in 0 | 1 | 2 | 4 | 5 | 8 | 12) printf '\1' ;; *) printf '\0' ;; esac
    done
    for ((key = 0; key < 7 * 128; key++)); do printf '\0\2'; done
} >"$tree/keymap"

find "$tree" -exec touch --no-dereference --date="@$SOURCE_DATE_EPOCH" {} +
(cd "$tree" && find . -print0 | LC_ALL=C sort -z | cpio --quiet --reproducible --null --owner=0:0 -o -H newc) |
    zstd -q "-$level" --single-thread >"$out"
