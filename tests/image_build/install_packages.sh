#!/usr/bin/env bash
# Installs the packages into a new, small Debian 12, uses them there, updates, removes and purges them. It fetches Debian's packages.
#
#   install_packages.sh [FOLDER]    FOLDER: the folder of the packages; without it they are packed from build/release
#
# Exit status 77: mmdebstrap is not on this machine.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
if ! command -v mmdebstrap >/dev/null; then
    echo "left out: mmdebstrap is not installed: ./setup.sh hil"
    exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work" # without root, mmdebstrap works as another user
if (($# > 0)); then
    mkdir "$work/debs"
    cp "$1"/frustumscreen*.deb "$work/debs/"
else
    "$here/../../image_build/packages" --no-build --out "$work/debs"
fi
cp "$here/installed_checks.sh" "$work/"

# The same packages with a later version, for the update
mkdir "$work/later"
for package in "$work"/debs/*.deb; do
    dpkg-deb --raw-extract "$package" "$work/tree"
    sed -i -E 's/^(Version: .*)$/\1+later/; s/(frustumscreen-base \(= [^)]*)\)/\1+later)/' "$work/tree/DEBIAN/control"
    dpkg-deb --root-owner-group -Znone --build "$work/tree" "$work/later/" >/dev/null
    rm -r "$work/tree"
done

mmdebstrap --quiet --variant=apt \
    --customize-hook="mkdir -p \"\$1/packages\"" \
    --customize-hook="cp -r $work/debs $work/later $work/installed_checks.sh \"\$1/packages/\"" \
    --customize-hook="chroot \"\$1\" bash /packages/installed_checks.sh" \
    bookworm /dev/null
