#!/usr/bin/env bash
# Installs what is missing of the Debian 12 packages that FrustumScreen is built from, and says which.
# ./run and ./test call it; with everything there it takes a fraction of a second.
#
#   ./setup.sh [hil]    hil: also what an emulated machine is made of
set -euo pipefail

packages=(
    # tools
    build-essential cmake ninja-build pkg-config shellcheck clang-format python3 pyflakes3
    systemd # its tools check the units
    # fuzzing
    clang-14 libclang-rt-14-dev llvm-14
    # small libraries
    libglm-dev libfmt-dev libexpected-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libsodium-dev
    libminizip-dev zlib1g-dev libgtest-dev
    # meshes and ray casting
    libembree-dev libmeshoptimizer-dev libdraco-dev libtinyobjloader-dev
    # pictures and letters
    libpng-dev libturbojpeg0-dev libwebp-dev libfreetype-dev fonts-dejavu-core
    # devices
    libgpiod-dev libusb-1.0-0-dev libhidapi-dev umockdev libumockdev-dev libevdev-dev libsystemd-dev
    # projectors
    libdrm-dev libgbm-dev libudev-dev libxcvt-dev
    # a window on a desktop
    libsdl2-dev
    # the bench's plots
    python3-matplotlib
    # OpenGL ES without a screen
    libegl-dev libgles-dev libegl1 libgles2 libegl-mesa0 libgl1-mesa-dri
)
if [[ ${1-} == hil ]]; then
    packages+=(python3 qemu-system-x86 mmdebstrap squashfs-tools busybox-static)
fi

missing=()
installed=$'\n'$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)$'\n'
for package in "${packages[@]}"; do
    if [[ $installed != *$'\n'"installed $package"$'\n'* ]]; then
        missing+=("$package")
    fi
done
if ((${#missing[@]} == 0)); then
    exit 0
fi

if ! grep -qs '^VERSION_ID="12"' /etc/os-release; then
    echo "setup.sh: this is not Debian 12; install these packages' like yourself: ${missing[*]}" >&2
    exit 1
fi
as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        echo "setup.sh: run this as root, or install sudo, so that it can install: ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi
echo "Installing Debian packages: ${missing[*]}"
"${as_root[@]}" apt-get -qq update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq install --yes --no-install-recommends "${missing[@]}" >/dev/null
