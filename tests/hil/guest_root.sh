#!/usr/bin/env bash
# Makes the guest's Debian: a root file system with the stock kernel and the libraries that our programs need,
# without our programs.
#
#   guest_root.sh FOLDER PACKAGE...    leaves FOLDER/{vmlinuz,initrd.img,root.squashfs}; PACKAGE: libraries of ours
#
# Three files instead of a disk: QEMU loads kernel and initrd itself. The initrd lays the first drive (this
# root), the second (our programs, guest_payload.sh) and a RAM disk over one another, so that every start
# begins from the same state. They are uncompressed, because an emulated processor unpacks slowly and the host
# keeps the file in memory anyway.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$1
shift
mkdir -p "$folder"
folder=$(readlink -f "$folder")

packages=(
    systemd systemd-sysv udev dbus kmod util-linux procps qemu-guest-agent
    # libraries that our programs open by name at run time, which ldd does not see
    libegl-mesa0 libgl1-mesa-dri libgbm1
    # sticks
    ntfs-3g
    # for a person with a shell
    gpiod usbutils less
    "$@"
)
# The stock kernel's drivers that the tests meet; modules that they need are added.
modules=(
    virtio_pci virtio_blk virtio_console virtio_rng squashfs overlay
    bochs virtio-gpu
    snd_hda_intel snd_hda_codec_generic
    xhci_pci usbhid hid_generic hid_cp2112 evdev i6300esb
    usb_storage uas sd_mod vfat nls_cp437 nls_ascii nls_iso8859_1 nls_utf8 exfat ext4 crc32c_generic fuse
)
initrd_modules=(virtio_pci virtio_blk squashfs overlay)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 777 "$work" # without root, mmdebstrap works as another user

# Runs inside mmdebstrap with the new root as $1: the kernel's package is unpacked, not installed, because
# installing it would build its own initrd.
cat >"$work/kernel_hook" <<HOOK
set -eu
root=\$1
cd "$work"
export APT_CONFIG=\$MMDEBSTRAP_APT_CONFIG
package=\$(apt-cache depends linux-image-amd64 | sed -n 's/^ *Depends: //p' | head -1)
apt-get download -qq -o APT::Sandbox::User=root "\$package"
mkdir kernel
dpkg-deb -x "\$package"_*.deb kernel
version=\$(ls kernel/lib/modules)
mkdir -p "\$root/usr/lib/modules"
mv "kernel/lib/modules/\$version" "\$root/usr/lib/modules/"
chroot "\$root" depmod "\$version"
bash "$here/guest_vkms.sh" "\$version" "$work/vkms.ko" &
vkms=\$!
needed() { # paths below kernel/, in the order of loading
    for module; do
        chroot "\$root" modprobe --set-version "\$version" --show-depends "\$module" | sed -n 's#^insmod .*/kernel/##p'
    done | awk '!seen[\$0]++'
}
needed ${modules[*]} >keep
mkdir -p initrd/bin initrd/modules initrd/dev initrd/proc initrd/sys initrd/debian initrd/payload initrd/memory initrd/root
needed ${initrd_modules[*]} | while read -r module; do
    cp "\$root/usr/lib/modules/\$version/kernel/\$module" initrd/modules/
    basename "\$module"
done >initrd/modules/order
mv "\$root/usr/lib/modules/\$version/kernel" all
while read -r module; do
    mkdir -p "\$root/usr/lib/modules/\$version/kernel/\$(dirname "\$module")"
    cp "all/\$module" "\$root/usr/lib/modules/\$version/kernel/\$module"
done <keep
wait \$vkms
install -D -m 644 -t "\$root/usr/lib/modules/\$version/updates" vkms.ko
chroot "\$root" depmod "\$version"
cp "kernel/boot/vmlinuz-\$version" vmlinuz
HOOK

# Runs with the new root as \$1: makes a machine that starts fast, keeps nothing, and lets root in on its
# serial line.
cat >"$work/settings_hook" <<'HOOK'
set -eu
root=$1
echo kiosk >"$root/etc/hostname"
echo 0123456789abcdef0123456789abcdef >"$root/etc/machine-id"
echo 'tmpfs /tmp tmpfs defaults 0 0' >"$root/etc/fstab"
sed -i 's#^root:[^:]*:#root::#' "$root/etc/shadow"
ln -sf /lib/systemd/system/multi-user.target "$root/etc/systemd/system/default.target"
for unit in apt-daily.timer apt-daily-upgrade.timer dpkg-db-backup.timer e2scrub_all.timer e2scrub_reap.service \
    fstrim.timer getty@tty1.service systemd-timesyncd.service systemd-update-utmp.service; do
    ln -sf /dev/null "$root/etc/systemd/system/$unit"
done
mkdir -p "$root/etc/systemd/journald.conf.d" "$root/etc/systemd/system/serial-getty@ttyS0.service.d"
printf '[Journal]\nStorage=volatile\nRateLimitBurst=0\n' >"$root/etc/systemd/journald.conf.d/hil.conf"
printf '[Service]\nExecStart=\nExecStart=-/sbin/agetty --autologin root --noclear %%I 115200 vt100\n' \
    >"$root/etc/systemd/system/serial-getty@ttyS0.service.d/hil.conf"
rm -rf "$root"/var/cache/* "$root"/var/lib/apt/* "$root"/boot/* "$root"/usr/share/{doc,man,locale,info,bug,lintian}/*
HOOK

exclude=()
for folder_left_out in doc man locale info lintian bug i18n/charmaps; do
    exclude+=(--dpkgopt="path-exclude=/usr/share/$folder_left_out/*")
done
include=$(IFS=,; echo "${packages[*]}")
mmdebstrap --quiet --variant=essential --include="$include" --aptopt='Apt::Install-Recommends "false"' "${exclude[@]}" \
    --customize-hook="sh $work/kernel_hook \"\$1\"" --customize-hook="bash $work/settings_hook \"\$1\"" \
    bookworm - |
    sqfstar -quiet -no-progress -noI -noD -noF -no-xattrs "$work/root.squashfs" >"$work/sqfstar.log" 2>&1 ||
    { cat "$work/sqfstar.log" >&2; exit 1; }

cp /bin/busybox "$work/initrd/bin/"
install -m 755 "$here/guest_init" "$work/initrd/init"
(cd "$work/initrd" && find . | busybox cpio -o -H newc 2>/dev/null) | gzip -1 >"$work/initrd.img"
mv "$work/vmlinuz" "$work/initrd.img" "$work/root.squashfs" "$folder/"
