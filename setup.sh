#!/usr/bin/env bash
# Installs the missing Debian 12 packages of those that a command needs, and names them. ./run and ./test call it; if none is
# missing it takes a fraction of a second; usage below.
set -euo pipefail

usage="usage: ./setup.sh [window|kiosk|tests|tidy|coverage|fuzz|hil|bundle|packages|image]...

No part: what ./run builds and runs. Each part comes on top of that: window: frustumscreen-window; kiosk: frustumscreen-safe;
tests: ./test, with both; tidy, coverage: ./test tidy and ./test coverage, with these three; fuzz: ./test fuzz;
hil: ./test hil, with kiosk; packages: image_build/packages, with window and kiosk;
bundle: image_build/bundle; image: image_build/build, with these"

packages=(
    # tools
    build-essential cmake ninja-build pkg-config
    # small libraries
    libglm-dev libeigen3-dev libceres-dev libfmt-dev libexpected-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libsodium-dev
    libminizip-dev zlib1g-dev
    # meshes and ray casting
    libembree-dev libmeshoptimizer-dev libdraco-dev libtinyobjloader-dev
    # pictures and letters
    libpng-dev libturbojpeg0-dev libwebp-dev libtiff-dev libstb-dev libfreetype-dev fonts-dejavu-core libqrencode-dev
    # shaped texts and speech
    libpango1.0-dev libglib2.0-dev libsndfile1-dev libsamplerate0-dev libebur128-dev
    fonts-noto-core espeak-ng # for every language but Chinese, Japanese and Korean; a voice
    # devices
    libgpiod-dev libusb-1.0-0-dev libhidapi-dev libevdev-dev libsystemd-dev libapriltag-dev
    # sound
    libasound2-dev libopusfile-dev
    # projectors
    libdrm-dev libgbm-dev libudev-dev libxcvt-dev
    # OpenGL ES without a screen
    libegl-dev libgles-dev libegl1 libgles2 libegl-mesa0 libgl1-mesa-dri
)
for part; do
    case "$part" in
        window) packages+=(libsdl2-dev) ;;
        kiosk) packages+=(fonts-noto-cjk) ;; # the safe picture's words, in all languages
        tests)
            packages+=(
                ccache mold libgtest-dev umockdev libumockdev-dev python3
                python3-scipy                     # another solver for the calibration
                systemd                           # its tools check the units
                libharfbuzz-dev fonts-noto-cjk    # texts in all languages
                minisign unzip                    # signatures
                strace                            # what a program asks of the kernel
                tzdata                            # time zones
                rauc openssl                      # updates
                dpkg-dev file                     # the Debian packages
                python3-matplotlib                # the bench's plots
                python3-prometheus-client         # reads what status says to Prometheus
                zbar-tools                        # reads the QR code of the staff's picture
                chromium                          # shows the preview's page; 120 MB to fetch, 400 on the disk
                lintian                           # looks at the Debian packages
                squashfs-tools cpio zstd fdisk dosfstools mtools       # make a small image for tests, and unpack it
                cryptsetup-bin e2fsprogs                               # make a small disk as a power cut leaves it
                python3-jsonschema python3-license-expression          # read the image's bill of materials
                shellcheck clang-format pyflakes3                      # check the style of the code
            )
            ;;
        image)
            packages+=(
                mmdebstrap uidmap kmod systemd uuid-runtime python3                  # the root, from Debian's packages
                squashfs-tools cryptsetup-bin cpio zstd binutils sbsigntool faketime # the image of the root, the kernel image
                fdisk dosfstools mtools e2fsprogs                                    # the disk
                python3-jsonschema python3-license-expression                        # read the bill of materials
                rauc openssl                                                         # updates
            )
            ;;
        tidy) packages+=(clang-tidy-16 python3) ;;
        coverage) packages+=(gcovr) ;;
        fuzz) packages+=(clang-14 libclang-rt-14-dev llvm-14 libgtest-dev) ;;
        bundle) packages+=(rauc openssl squashfs-tools) ;; # image_build/bundle
        packages) packages+=(dpkg-dev file python3) ;; # file: CPack recognizes programs with it; python3: manual pages
        hil)
            packages+=(
                python3 qemu-system-x86 ovmf mmdebstrap squashfs-tools busybox-static
                dosfstools mtools exfatprogs e2fsprogs ntfs-3g # sticks
            )
            ;;
        -h | --help)
            echo "$usage"
            exit 0
            ;;
        *)
            echo "$usage" >&2
            exit 2
            ;;
    esac
done

find_missing() {
    local installed package
    missing=()
    installed=$'\n'$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)$'\n'
    for package in "${packages[@]}"; do
        if [[ $installed != *$'\n'"installed $package"$'\n'* ]]; then
            missing+=("$package")
        fi
    done
    ((${#missing[@]} > 0))
}
find_missing || exit 0

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
# Only one run installs at a time, because a second one would find APT's lists locked. After the wait, the list of missing packages is
# made again: the other run may have installed some.
exec 9<"${BASH_SOURCE[0]}"
flock 9
find_missing || exit 0
echo "Installing Debian packages: ${missing[*]}"
"${as_root[@]}" apt-get -qq update 9>&-
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=600 install --yes --no-install-recommends \
    "${missing[@]}" >/dev/null 9>&-
