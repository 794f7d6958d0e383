#!/usr/bin/env bash
# Installs a kiosk's files from the build folder $1 into a new root, and checks units, users, folders and udev
# rules with systemd's own tools. Exit status 77: a tool is missing, and its check was left out.
set -euo pipefail
build=$1

own=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../image_build/files/usr/lib # the image's
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

install_kiosk() {
    local component
    for component in base kiosk; do
        DESTDIR=$root cmake --install "$build" --component "$component" >/dev/null
    done
}
install_kiosk
install_kiosk # again: it changes nothing
units=$root/usr/lib/systemd/system
unit=$units/frustumscreen.service

# The files that the unit starts and reads exist.
program=$(sed -n 's/^ExecStart=\([^ ]*\).*/\1/p' "$unit")
[[ -x $root$program ]] || die "$program is not installed"
settings=$(sed -n 's/^ExecStart=.*--config \([^ ]*\).*/\1/p' "$unit")
resolved=$("$root$program" config --config "$root$settings" --json)
grep -q '"/var/lib/frustumscreen/packs/amphora.fspack"' <<<"$resolved" ||
    die "the installed settings do not name the installed packs"
[[ $(stat -c %s "$root/usr/share/frustumscreen/built_in.fspack") -lt 400000 ]] || die "the built-in artifact is large"
"$root$program" config --config "$root/usr/share/frustumscreen/kiosk.toml" --json >/dev/null || die "the shipped settings are wrong"
echo '# the museum'"'"'s own' >"$root$settings"
install_kiosk
grep -q "museum's own" "$root$settings" || die "a museum's own settings were overwritten"

# Both services open the camera, with the rights of their user, who is in the group video (checked below). So no list of devices may exclude
# it, and no other group may be set.
for name in frustumscreen frustumscreen-calibrate; do
    grep -q '^User=frustumscreen$' "$units/$name.service" || die "$name.service runs as another user than the one in the group video"
    shut=$(cat "$units/$name.service" "$units/$name.service.d"/*.conf "$own/systemd/system/$name.service.d"/*.conf 2>/dev/null |
        grep -E '^(PrivateDevices|DevicePolicy|DeviceAllow|PrivateUsers|Group)=' || true)
    [[ -z $shut ]] || die "$name.service may not open the camera: $shut"
done

if command -v systemd-analyze >/dev/null && [[ -d /usr/lib/systemd/system ]]; then
    cp --no-clobber --recursive /usr/lib/systemd/system/. "$units" # the targets that it depends on
    install -D -m 755 /bin/sh "$root/bin/sh" # Debian's own, which a unit calls
    said=$(systemd-analyze verify --root="$root" "$unit" 2>&1) || die "systemd-analyze verify: $said"
    # For an unknown key the tool only prints a warning.
    grep frustumscreen <<<"$said" && die "systemd-analyze verify warns"
    locked_in() { # UNIT TENTHS: the exposure is no larger
        systemd-analyze security --no-pager --offline=true --threshold="$2" --root="$root" "$1" >"$root/security" ||
            die "$1 has more privileges than allowed: $(grep '✗' "$root/security")"
    }
    locked_in frustumscreen.service 16
    said=$(systemd-analyze verify --root="$root" "$units/frustumscreen-safe.service" 2>&1) || die "systemd-analyze verify: $said"
    grep frustumscreen <<<"$said" && die "systemd-analyze verify warns about the safe picture"
    locked_in frustumscreen-safe.service 4
    said=$(systemd-analyze verify --root="$root" "$units/frustumscreen-calibrate.path" "$units/frustumscreen-calibrate.service" 2>&1) ||
        die "systemd-analyze verify: $said"
    grep frustumscreen <<<"$said" && die "systemd-analyze verify warns about the calibration"
    locked_in frustumscreen-calibrate.service 16
    said=$(systemd-analyze verify --root="$root" "$units/frustumscreen-watchdog.service" 2>&1) || die "systemd-analyze verify: $said"
    grep frustumscreen <<<"$said" && die "systemd-analyze verify warns about the watchdog"
    locked_in frustumscreen-watchdog.service 4
    locked_in frustumscreen-step@reboot.service 11
    # The units of sticks, for the stick stick1p1; the programs that they start and their sandbox exist.
    for name in stick ntfs import import-refused; do
        instance=$units/frustumscreen-$name@stick1p1.service
        cp "$units/frustumscreen-$name@.service" "$instance"
        said=$(systemd-analyze verify --root="$root" "$instance" 2>&1) || true
        said=$(grep "frustumscreen-$name@" <<<"$said" | grep -v 'is not executable: No such file' || true)
        [[ -z $said ]] || die "systemd-analyze verify: $said"
        rm "$instance"
    done
    locked_in frustumscreen-import@stick1p1.service 1
    locked_in frustumscreen-import-refused@stick1p1.service 1
    locked_in frustumscreen-stick@stick1p1.service 24
    locked_in frustumscreen-ntfs@stick1p1.service 34
    # The image's additions for its updates.
    cp -r "$own/systemd/system/." "$units" && cp -r "$own/frustumscreen" "$root/usr/lib/"
    for name in update@stick1p1 update-told@stick1p1 report-open@stick1p1 report@stick1p1 report-close@stick1p1 next-try reset copy; do
        instance=$units/frustumscreen-$name.service
        [[ -e $instance ]] || cp "$units/frustumscreen-${name%%@*}@.service" "$instance"
        said=$(systemd-analyze verify --root="$root" "$instance" 2>&1) || true
        said=$(grep "frustumscreen-${name%%@*}" <<<"$said" | grep -v 'is not executable: No such file' || true)
        [[ -z $said ]] || die "systemd-analyze verify: $said"
    done
    locked_in frustumscreen-update@stick1p1.service 18
    locked_in frustumscreen-update-told@stick1p1.service 13
    locked_in frustumscreen-next-try.service 19
    locked_in frustumscreen-reset.service 19
    locked_in frustumscreen-copy.service 13
    locked_in frustumscreen-report@stick1p1.service 6
    locked_in frustumscreen-report-open@stick1p1.service 41
    locked_in frustumscreen-report-close@stick1p1.service 41
else
    skip "systemd-analyze is not installed"
fi

if command -v systemd-sysusers >/dev/null && command -v systemd-tmpfiles >/dev/null; then
    systemd-sysusers --root="$root" frustumscreen.conf >/dev/null 2>&1 || die "systemd-sysusers"
    for group in video render input plugdev gpio; do
        grep -Eq "^$group:.*[:,]frustumscreen(,|$)" "$root/etc/group" || die "the user is not in the group $group"
    done
    for user in frustumscreen-import frustumscreen-ntfs frustumscreen-safe frustumscreen-watchdog; do
        grep -q "^$user:" "$root/etc/passwd" || die "there is no user $user"
        grep -Eq "[:,]$user(,|$)" "$root/etc/group" && die "the user $user is in a group"
    done
    if ((EUID == 0)); then
        for _ in 1 2; do # again: it changes nothing
            systemd-tmpfiles --root="$root" --create frustumscreen.conf || die "systemd-tmpfiles"
        done
        [[ -d $root/var/lib/frustumscreen/packs ]] || die "there is no folder for packs"
        owner() { # FOLDER USER: this user of the new root owns it
            local number
            number=$(sed -n "s/^$2:x:\([0-9]*\):.*/\1/p" "$root/etc/passwd")
            [[ $(stat -c %u "$root$1") == "$number" ]] || die "$1 does not belong to $2"
        }
        owner /var/lib/frustumscreen/library frustumscreen-import
        owner /var/lib/frustumscreen/library/shown frustumscreen
        owner /run/frustumscreen-import frustumscreen-import
        owner /var/lib/frustumscreen/calibration frustumscreen
        owner /run/frustumscreen-staff frustumscreen
        [[ $(stat -c %a "$root/run/frustumscreen-staff") == 2750 ]] || die "the staff's folder is open to others"
        staff=$(sed -n 's/^frustumscreen-staff:x:\([0-9]*\):.*/\1/p' "$root/etc/group")
        [[ $(stat -c %g "$root/run/frustumscreen-staff") == "$staff" ]] || die "the staff's folder is not the staff's"
    fi
else
    skip "systemd-sysusers or systemd-tmpfiles is not installed"
fi

# udev's grammar: KEY or KEY{attribute}, an operator, a text in quotes; separated by commas.
rules=("$root"/usr/lib/udev/rules.d/*-frustumscreen*.rules)
pair='[A-Z]+(\{[^}"]+\})?(==|!=|=|\+=|-=|:=)"(\\"|[^"])*"'
wrong=$(grep -Evn "^(#.*|)$|^$pair(, *$pair)*$" "${rules[@]}") && die "no udev rule: $wrong"
if command -v udevadm >/dev/null && udevadm verify --help >/dev/null 2>&1; then
    udevadm verify "${rules[@]}" || die "udevadm verify"
else
    echo "looked at the udev rules' grammar alone: udevadm cannot verify them before version 253"
fi
exit $skipped
