#!/usr/bin/env bash
# Installs the kiosk's part of the build folder $1 into a new root and checks its units, users, folders and
# udev rules with systemd's own tools. Exit status 77: a tool is missing, and its check was left out.
set -euo pipefail
build=$1

root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
skipped=0
skip() {
    echo "left out: $*"
    skipped=77
}
die() {
    echo "failed: $*" >&2
    exit 1
}

DESTDIR=$root cmake --install "$build" --component kiosk >/dev/null
DESTDIR=$root cmake --install "$build" --component kiosk >/dev/null # again: it changes nothing
units=$root/usr/lib/systemd/system
unit=$units/frustumscreen.service

# What the unit starts and reads is there.
program=$(sed -n 's/^ExecStart=\([^ ]*\).*/\1/p' "$unit")
[[ -x $root$program ]] || die "$program is not installed"
settings=$(sed -n 's/^ExecStart=.*--config \([^ ]*\).*/\1/p' "$unit")
resolved=$("$root$program" config --config "$root$settings" --json)
grep -q '"/var/lib/frustumscreen/packs/amphora.fspack"' <<<"$resolved" ||
    die "the installed settings do not name the installed packs"
echo '# the museum'"'"'s own' >"$root$settings"
DESTDIR=$root cmake --install "$build" --component kiosk >/dev/null
grep -q "museum's own" "$root$settings" || die "a museum's own settings were overwritten"

if command -v systemd-analyze >/dev/null && [[ -d /usr/lib/systemd/system ]]; then
    cp --no-clobber --recursive /usr/lib/systemd/system/. "$units" # the targets that it depends on
    said=$(systemd-analyze verify --root="$root" "$unit" 2>&1) || die "systemd-analyze verify: $said"
    # For a key that it does not know the tool only prints a warning.
    grep frustumscreen <<<"$said" && die "systemd-analyze verify has doubts"
    systemd-analyze security --offline=true --threshold=20 --root="$root" frustumscreen.service >/dev/null ||
        die "the service is locked in less than it was; see systemd-analyze security"
else
    skip "systemd-analyze is not installed"
fi

if command -v systemd-sysusers >/dev/null && command -v systemd-tmpfiles >/dev/null; then
    systemd-sysusers --root="$root" frustumscreen.conf >/dev/null 2>&1 || die "systemd-sysusers"
    for group in video render input plugdev gpio; do
        grep -Eq "^$group:.*[:,]frustumscreen(,|$)" "$root/etc/group" || die "the user is not in the group $group"
    done
    if ((EUID == 0)); then
        systemd-tmpfiles --root="$root" --create frustumscreen.conf || die "systemd-tmpfiles"
        [[ -d $root/var/lib/frustumscreen/packs ]] || die "there is no folder for packs"
    fi
else
    skip "systemd-sysusers or systemd-tmpfiles is not installed"
fi

# udev's grammar: KEY or KEY{attribute}, an operator, a text in quotes; commas between.
rules=$root/usr/lib/udev/rules.d/70-frustumscreen.rules
pair='[A-Z]+(\{[^}"]+\})?(==|!=|=|\+=|-=|:=)"[^"]*"'
wrong=$(grep -Evn "^(#.*|)$|^$pair(, *$pair)*$" "$rules") && die "no udev rule: $wrong"
if command -v udevadm >/dev/null && udevadm verify --help >/dev/null 2>&1; then
    udevadm verify "$rules" || die "udevadm verify"
else
    echo "looked at the udev rules' grammar alone: udevadm cannot verify them before version 253"
fi
exit $skipped
