#!/usr/bin/env bash
# Builds the kernel's virtual display (vkms), which Debian's kernel lacks, for the guest's kernel. It is a card with
# real vblanks. A test sets the time of its modeset (module parameter modeset_ms), because some projectors have a
# slow one.
#
#   guest_vkms.sh VERSION OUT.ko    VERSION: as in /lib/modules; APT_CONFIG: apt's configuration, for the packages' source
#
# Downloads 150 MB, most of it the kernel's whole source, because Debian has no smaller package.
set -euo pipefail
version=$1 out=$2
abi=${version%-*} # for 6.1.0-1-amd64, the headers of all flavours are in 6.1.0-1-common
series=$(cut -d. -f1,2 <<<"$version")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root "linux-source-$series" "linux-headers-$version" \
    "linux-headers-$abi-common" "linux-kbuild-$series"
for package in linux-headers-*.deb linux-kbuild-*.deb; do
    dpkg-deb -x "$package" headers
done
sed -i "s#/usr/src#$work/headers/usr/src#" "headers/usr/src/linux-headers-$version/Makefile"
dpkg-deb --fsys-tarfile linux-source-*.deb | tar -xO "./usr/src/linux-source-$series.tar.xz" | xz -dc -T0 |
    tar -x --strip-components=4 --wildcards '*/drivers/gpu/drm/vkms/*'

# The modeset waits at the place where a driver waits for its hardware: before the vblanks begin.
sed -i -e 's/^\tdrm_crtc_vblank_on(crtc);/\tmsleep(modeset_ms);\n&/' \
    -e '0,/^static /s//static unsigned int modeset_ms;\nmodule_param(modeset_ms, uint, 0644);\n&/' \
    -e '1i #include <linux/delay.h>\n#include <linux/module.h>' vkms/vkms_crtc.c
grep -q 'msleep(modeset_ms)' vkms/vkms_crtc.c
make -s -C "headers/usr/src/linux-headers-$version" M="$work/vkms" CONFIG_DRM_VKMS=m modules >make.log 2>&1 ||
    { cat make.log >&2; exit 1; }
strip --strip-debug vkms/vkms.ko
mv vkms/vkms.ko "$out"
