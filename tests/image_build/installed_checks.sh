#!/usr/bin/env bash
# Runs in a new Debian, as root; install_packages.sh calls it. /packages has debs/ and later/, the same packages with a later version.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
cd /packages
say() { printf '== %s\n' "$*"; }
die() {
    echo "failed: $*" >&2
    exit 1
}
install() { # OPTION... PACKAGE...
    apt-get -qq install --yes "$@" </dev/null >apt.log 2>&1 || { cat apt.log >&2; die "apt install $*"; }
}
used_mb() { du -smx / | cut -f1; }
version=$(dpkg-deb --field debs/frustumscreen_*.deb Version)
find / -xdev -not -path '/packages*' -not -path '/proc/*' -not -path '/sys/*' | sort >before

say "the exhibit, without anything that is only recommended"
was=$(used_mb)
install --no-install-recommends ./debs/frustumscreen_*.deb ./debs/frustumscreen-base_*.deb
echo "   $(($(used_mb) - was)) MB on the disk"
grep -Ei 'warning|error|fail' apt.log | grep -v 'debconf\|apt-utils' && die "the installation has doubts"
[[ $(frustumscreen --version) == "frustumscreen $version" ]] || die "frustumscreen --version"
[[ $(systemctl is-enabled frustumscreen.service || true) == disabled ]] || die "the exhibit is enabled"
[[ $(systemctl is-enabled frustumscreen-watchdog.service || true) == disabled ]] || die "the watchdog is enabled"
for user in frustumscreen frustumscreen-import frustumscreen-ntfs frustumscreen-safe frustumscreen-watchdog; do
    getent passwd "$user" >/dev/null || die "there is no user $user"
done
id -nG frustumscreen | grep -w plugdev >/dev/null || die "the exhibit's user may not open trackers"
[[ $(stat -c %U /var/lib/frustumscreen/library) == frustumscreen-import ]] || die "the library is not the importer's"
[[ -u /bin/ntfs-3g || -x /bin/ntfs-3g ]] || die "there is no ntfs-3g"
frustumscreen config --config /etc/frustumscreen/kiosk.toml --json >/dev/null 2>&1 || die "the settings are not taken"
systemd-analyze verify frustumscreen.service frustumscreen-watchdog.service frustumscreen-safe.service || die "the units"
for program in /usr/bin/frustumscreen*; do
    ldd "$program" | grep 'not found' && die "$program lacks a library"
done
frustumscreen run --config /etc/frustumscreen/kiosk.toml --packs /usr/share/frustumscreen/built_in.fspack \
    --headless --seconds 1 --stills 1 --out shown >run.log 2>&1 || { cat run.log >&2; die "nothing is shown"; }
[[ -s shown/frame_00000.png ]] || die "there is no picture"
frustumscreen-safe --png safe.png --size 640x400 || die "the safe picture"

say "the museum's settings and packs, and an update"
systemctl --quiet enable frustumscreen.service frustumscreen-watchdog.service
echo "# the museum's own" >>/etc/frustumscreen/kiosk.toml
touch /var/lib/frustumscreen/packs/own.fspack
mkdir -p /var/cache/frustumscreen /var/lib/frustumscreen-watchdog && touch /var/cache/frustumscreen/x /var/lib/frustumscreen-watchdog/faults
install --no-install-recommends ./later/frustumscreen_*.deb ./later/frustumscreen-base_*.deb
[[ $(dpkg-query -W -f '${Version}' frustumscreen) == "$version+later" ]] || die "the update was not installed"
[[ $(tail -n 1 /etc/frustumscreen/kiosk.toml) == "# the museum's own" ]] || die "a museum's settings were overwritten"
[[ $(systemctl is-enabled frustumscreen.service) == enabled ]] || die "the update has disabled the exhibit"

say "removed, installed again"
apt-get -qq remove --yes frustumscreen >apt.log 2>&1 || die "apt remove"
[[ -e /usr/lib/systemd/system/frustumscreen.service ]] && die "the unit is left"
[[ -e /var/lib/frustumscreen/packs/own.fspack && -e /etc/frustumscreen/kiosk.toml ]] || die "packs or settings were removed"
install --no-install-recommends ./later/frustumscreen_*.deb
[[ $(systemctl is-enabled frustumscreen.service) == enabled ]] || die "the exhibit, enabled before the removal, is not"

say "purged"
apt-get -qq purge --yes frustumscreen frustumscreen-base >apt.log 2>&1 || die "apt purge"
grep -Ei 'warning|error|fail' apt.log && die "the purge has doubts"
left=$(find / -xdev -not -path '/packages*' -not -path '/proc/*' -not -path '/sys/*' -path '*frustumscreen*' | sort)
printf '   left: %s\n' "${left//$'\n'/$'\n   left: '}"
wanted='/run/frustumscreen-import
/run/frustumscreen-import-root
/run/frustumscreen-staff
/run/frustumscreen-stick
/var/lib/frustumscreen
/var/lib/frustumscreen/packs
/var/lib/frustumscreen/packs/own.fspack'
[[ $(grep -v '^/run/' <<<"$left") == $(grep -v '^/run/' <<<"$wanted") ]] || die "a purge leaves these"

say "a curator's computer, with what is recommended"
was=$(used_mb)
install --install-recommends ./debs/frustumscreen-bake_*.deb ./debs/frustumscreen-base_*.deb
echo "   $(($(used_mb) - was)) MB on the disk"
[[ ! -e /usr/lib/systemd/system/frustumscreen.service && ! -e /usr/lib/udev/rules.d/71-frustumscreen-stick.rules ]] ||
    die "a curator's computer has become an exhibit"
frustumscreen-bake --help >/dev/null
frustumscreen-artifact amphora --triangles 2000 --folder amphora
frustumscreen-bake amphora -o amphora.fspack --size 64 --preview amphora.html >bake.log 2>&1 || { cat bake.log >&2; die "the bake"; }
sed 's/^/   /' bake.log
frustumscreen-pack verify amphora.fspack >/dev/null || die "the pack is not sound"
grep -q 'lost *nothing' bake.log || die "the bake has lost something"
frustumscreen-pack explain amphora.fspack | grep -i spoken >/dev/null || die "nobody speaks: espeak-ng is missing"
apt-get -qq purge --yes frustumscreen-bake frustumscreen-base >apt.log 2>&1 || die "apt purge"
say "good"
