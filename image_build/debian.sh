#!/usr/bin/env bash
# Makes the Debian system from which the image's files are taken: one tar with all files of the packages, with dpkg's data bases and
# the licences, and a list of the packages beside it.
#
#   debian.sh [--locked LIST] [--mirror URL] [--firmware amd] FOLDER
#
# FOLDER/debian.tar             the packages' files; kernel, boot loader and busybox below /unpacked
# FOLDER/packages.txt           name, version, architecture and source of each
# LIST has a line with name and version for each package: exactly these are taken. Without it, Debian's versions of today are taken.
# Without root, it works by the kernel's user namespaces (mmdebstrap's mode "unshare").
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
say_and_fail() {
    echo "build: $*" >&2
    exit 1
}

locked='' mirror='' firmware=''
while [[ $1 == --* ]]; do
    case $1 in
        --locked) locked=$2 && shift ;;
        --mirror) mirror=$2 && shift ;;
        --firmware) firmware=$2 && shift ;;
    esac
    shift
done
folder=$1
mkdir -p "$folder"
folder=$(readlink -f "$folder")

of_kind() { sed -n "s/^$1 \+\([^ ]*\).*/\1/p" "$here/packages.conf" ${firmware:+"$here/packages.$firmware.conf"}; }
mapfile -t install < <(of_kind install)
mapfile -t unpack < <(of_kind unpack)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 777 "$work" # without root, mmdebstrap works as another user
touch "$work/preferences"
cp "$here/contents/unpack_deb.sh" "$work/" # that user may not be able to read this folder
if [[ -n $locked ]]; then
    LC_ALL=C sort -u "$locked" >"$work/locked"
    # With a priority above 1000, apt takes this version even if a newer one is available.
    while read -r name version; do
        printf 'Package: %s\nPin: version %s\nPin-Priority: 1001\n\n' "$name" "$version"
    done <"$work/locked" >"$work/preferences"
    # Runs inside mmdebstrap once Debian's lists are there, so that it names missing versions before anything is installed. The candidate is
    # the pinned version if Debian has it, and otherwise Debian's newest version.
    cat >"$work/versions_hook" <<HOOK
set -eu
export APT_CONFIG=\$MMDEBSTRAP_APT_CONFIG
cut -d ' ' -f 1 "$work/locked" | xargs apt-cache policy | awk '
    NR == FNR { listed[++count] = \$1; version[\$1] = \$2; next }
    /^[^ ]/ { package = substr(\$1, 1, length(\$1) - 1) }
    \$1 == "Candidate:" { candidate[package] = \$2 }
    END {
        for (k = 1; k <= count; ++k) {
            package = listed[k]
            if (!(package in candidate) || candidate[package] != version[package]) {
                print "--locked has: " package, version[package]
                print "Debian has:  " (package in candidate ? package " " candidate[package] : "no package of this name")
            }
        }
    }' "$work/locked" - >"$work/differences"
! [ -s "$work/differences" ]
HOOK
fi

# Runs inside mmdebstrap with the new root as $1.
cat >"$work/unpack_hook" <<HOOK
set -eu
root=\$1
export APT_CONFIG=\$MMDEBSTRAP_APT_CONFIG
mkdir "$work/debs" "\$root/unpacked"
cd "$work/debs"
for package in ${unpack[*]}; do
    # linux-image-amd64 is empty and depends on the newest kernel.
    real=\$(apt-cache depends "\$package" | sed -n 's/^ *Depends: \(linux-image-.*\)/\1/p' | head -n 1)
    apt-get download -qq -o APT::Sandbox::User=root "\${real:-\$package}"
done
for deb in *.deb; do
    sh "$work/unpack_deb.sh" "\$deb" "\$root/unpacked"
    dpkg-deb -W --showformat '\${Package} \${Version} \${Architecture} \${source:Package} \${source:Version}\n' "\$deb"
done >"$work/unpacked.txt"
cd /
rm -r "$work/debs" # here, because without root only mmdebstrap's user may remove it
dpkg-query --admindir="\$root/var/lib/dpkg" -W \
    -f '\${Package} \${Version} \${Architecture} \${source:Package} \${source:Version}\n' >"$work/installed.txt"
rm -rf "\$root"/var/cache/* "\$root"/var/lib/apt "\$root"/var/log/*
# dpkg's option path-exclude would take mmdebstrap a minute, because it filters the essential packages' archives by a slow program.
for left_out in man locale info lintian bug i18n; do
    rm -rf "\$root/usr/share/\$left_out"/*
done
HOOK

include=$(IFS=,; echo "${install[*]}")
components=main
[[ -z $firmware ]] || components=main,non-free-firmware
say_versions_and_fail() {
    cat "$work/differences" >&2
    say_and_fail "Debian does not give the versions that --locked lists; the lines above say which." \
        "--mirror https://snapshot.debian.org/archive/debian/DATE/ has old ones; without --locked those of today are taken"
}
status=0
mmdebstrap --quiet --variant=essential --components="$components" --include="$include" \
    --aptopt='Apt::Install-Recommends "false"' \
    --setup-hook="mkdir -p \"\$1/etc/apt/preferences.d\" && cp \"$work/preferences\" \"\$1/etc/apt/preferences.d/recorded\"" \
    ${locked:+--extract-hook="sh $work/versions_hook"} --customize-hook="sh $work/unpack_hook \"\$1\"" \
    bookworm "$work/debian.tar" ${mirror:+"$mirror"} 2>"$work/log" || status=$?
if ((status != 0)); then
    [[ ! -s $work/differences ]] || say_versions_and_fail
    cat "$work/log" >&2
    say_and_fail "Debian's packages could not be fetched and unpacked; the lines above say why"
fi

LC_ALL=C sort -u "$work/installed.txt" "$work/unpacked.txt" >"$work/packages.txt"
if [[ -n $locked ]]; then
    # The lines that only one side has, because Debian may install other packages now. The order of the lists does not matter.
    comm -3 "$work/locked" <(cut -d ' ' -f 1,2 "$work/packages.txt" | LC_ALL=C sort -u) |
        sed 's/^\t/Debian has:  /; t; s/^/--locked has: /' >"$work/differences"
    [[ ! -s $work/differences ]] || say_versions_and_fail
fi
mv "$work/packages.txt" "$work/debian.tar" "$folder/"
