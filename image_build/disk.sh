#!/usr/bin/env bash
# Makes the disk, a file with four partitions, without root and without a loop device.
#
#   disk.sh --version V --data SIZE BOOT.efi KERNEL.efi SLOT OUT
#
#   frustumscreen-esp   FAT32: the boot loader, its closed settings, the kernel image with three tries
#   frustumscreen-a     SLOT
#   frustumscreen-b     empty: the first update's
#   frustumscreen-data  ext4, empty; it grows to the disk's end at the first start
set -euo pipefail
esp_mib=128 slot_mib=256
version=$2 data=$4
shift 4
boot=$1 kernel=$2 slot=$3 out=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
data_mib=$(($(numfmt --from=iec "$data") >> 20))
(($(stat -c %s "$slot") <= slot_mib << 20)) || {
    echo "build: the root takes $(($(stat -c %s "$slot") >> 20)) MiB, a slot has $slot_mib: see image_build/why, or raise slot_mib in disk.sh" >&2
    exit 1
}
uuid_of() { uuidgen --sha1 --namespace @dns --name "frustumscreen.invalid/$1"; }

cat >"$work/loader.conf" <<'CONF'
timeout 0
editor no
auto-entries no
auto-firmware no
console-mode keep
CONF
touch --date="@$SOURCE_DATE_EPOCH" "$work/loader.conf" "$boot" "$kernel"
truncate -s "${esp_mib}M" "$work/esp"
mkfs.vfat -F 32 --invariant -n FRUSTUM "$work/esp" >/dev/null
export MTOOLS_SKIP_CHECK=1
mmd -i "$work/esp" ::EFI ::EFI/BOOT ::EFI/Linux ::loader
mcopy -m -i "$work/esp" "$boot" ::EFI/BOOT/BOOTX64.EFI
mcopy -m -i "$work/esp" "$kernel" "::EFI/Linux/frustumscreen_$version+3.efi"
mcopy -m -i "$work/esp" "$work/loader.conf" ::loader/loader.conf

# From 128 MiB on, ext4 has a second superblock. An inode for each 16 KiB leaves space for many small files on a disk of any size.
# No blocks are reserved for root, because nobody logs in.
truncate -s "${data_mib}M" "$work/data"
E2FSPROGS_FAKE_TIME=$SOURCE_DATE_EPOCH mke2fs -q -t ext4 -b 4096 -i 16384 -m 0 -J size=16 -L frustumscreen -U "$(uuid_of data)" \
    -E "hash_seed=$(uuid_of hash),root_owner=0:0,lazy_itable_init=0,lazy_journal_init=0" "$work/data"

truncate -s "$((1 + esp_mib + 2 * slot_mib + data_mib + 1))M" "$work/disk"
sfdisk --quiet "$work/disk" <<TABLE
label: gpt
label-id: $(uuid_of disk)
start=1MiB, size=${esp_mib}MiB, type=C12A7328-F81F-11D2-BA4B-00A0C93EC93B, uuid=$(uuid_of esp), name=frustumscreen-esp
size=${slot_mib}MiB, type=4F68BCE3-E8CD-4DB1-96E7-FBCAF984B709, uuid=$(uuid_of a), name=frustumscreen-a
size=${slot_mib}MiB, type=4F68BCE3-E8CD-4DB1-96E7-FBCAF984B709, uuid=$(uuid_of b), name=frustumscreen-b
size=${data_mib}MiB, type=0FC63DAF-8483-4772-8E79-3D69D8477DE4, uuid=$(uuid_of data), name=frustumscreen-data
TABLE
put() { dd if="$1" of="$work/disk" bs=1M seek="$2" conv=notrunc,sparse status=none; }
put "$work/esp" 1
put "$slot" $((1 + esp_mib))
put "$work/data" $((1 + esp_mib + 2 * slot_mib))
mv "$work/disk" "$out"
