# shellcheck shell=bash
# The steps of ./image_build/build, which sources this file. Each step works in $work, on the files of the steps before it.
# shellcheck disable=SC2154 # ./image_build/build sets work

fail() {
    echo "build: $*" >&2
    exit 1
}

parse_arguments() {
    local usage=$1
    shift
    test_image=false level=19 keys='' packages='' firmware='' data_size=160M out='' locked='' mirror='' update_ca=''
    version=$(sed -n 's/^project(.* VERSION \([^ ]*\).*/\1/p' CMakeLists.txt)
    while (($# > 0)); do
        case $1 in
            --keys | --packages | --firmware | --version | --data | --out | --mirror | --update-ca | --locked)
                (($# > 1)) || { echo "build: $1 needs a value; --help says which" >&2; exit 2; }
                ;;&
            --test) test_image=true ;;
            --quick) level=1 ;;
            --keys) keys=$(readlink -f "$2") && shift ;;
            --packages) packages=$(readlink -f "$2") && shift ;;
            --update-ca) update_ca=$(readlink -f "$2") && shift ;;
            --firmware) firmware=$2 && shift ;;
            --version) version=$2 && shift ;;
            --data) data_size=$2 && shift ;;
            --out) out=$2 && shift ;;
            --mirror) mirror=$2 && shift ;;
            --locked) locked=$(readlink -f "$2") && shift ;;
            --help | -h) echo "$usage"; exit 0 ;;
            *) echo "build: there is no option '$1'; --help lists them" >&2; exit 2 ;;
        esac
        shift
    done
    [[ -z $firmware || $firmware == amd ]] || { echo "build: --firmware: '$firmware' is none; amd is" >&2; exit 2; }
    [[ $version =~ ^[0-9][0-9A-Za-z.~-]*$ ]] ||
        { echo "build: --version: '$version' does not begin with a digit, or has more than letters, digits, '.', '~' and '-'" >&2; exit 2; }
    if ! [[ $data_size =~ ^[1-9][0-9]*[MG]$ ]] || (($(numfmt --from=iec "$data_size") < 160 << 20)); then
        echo "build: --data: '$data_size' is not a number with M or G, 160M at least: smaller ones have no second superblock" >&2
        exit 2
    fi
    [[ -z $keys || ( -r $keys/db.key && -r $keys/db.crt ) ]] || fail "--keys: $keys has not both db.key and db.crt"
    [[ -z $update_ca ]] || openssl x509 -noout -in "$update_ca" 2>/dev/null || fail "--update-ca: $update_ca has no certificate (PEM)"
    [[ -z $locked || -r $locked ]] || fail "--locked: there is no file $locked; a build leaves packages.txt beside its image"
    [[ -z $packages || -d $packages ]] || fail "--packages: there is no folder $packages"
    : "${SOURCE_DATE_EPOCH:=$(git log -1 --format=%ct 2>/dev/null || echo 1)}"
    export SOURCE_DATE_EPOCH LC_ALL=C TZ=UTC
    umask 022
    out=${out:-out/image}
    ! $test_image || out=$out/test
    mkdir -p "$out" build/image
    out=$(readlink -f "$out") cache=$(readlink -f build/image)
}

step() { # WORDS FUNCTION
    local begun=$SECONDS
    printf '== %s\n' "$1"
    "$2"
    printf '   %d s\n' $((SECONDS - begun))
}

# Makes a UUID from words, for names that must be the same in two builds.
uuid_of() { uuidgen --sha1 --namespace @dns --name "frustumscreen.invalid/$1"; }

# Sets `debian` to a folder with Debian's packages. It is kept for the day, or with --locked as long as the list is the same. An image
# for tests and one for kiosks use the same folder. The user's cache folder has a copy of the day's packages for other clones.
fetch_debian() {
    local wanted key today copy
    wanted=$({ cat image_build/debian.sh image_build/packages.conf ${firmware:+"image_build/packages.$firmware.conf"}; echo "$mirror"; } |
        sha256sum | cut -c 1-8)
    today=$cache/today-$wanted # one line: the day, and the name of the folder with its packages
    copy=${XDG_CACHE_HOME:-$HOME/.cache}/frustumscreen/debian/$wanted-$(date +%F).tar.zst
    if [[ -n $locked ]]; then
        key=debian-$wanted-$(versions_in "$locked" | sha256sum | cut -c 1-8)
    elif [[ $(cut -d ' ' -f 1 "$today" 2>/dev/null) == $(date +%F) ]]; then
        key=$(cut -d ' ' -f 2 "$today")
    fi
    debian=$cache/${key:-none}
    [[ ! -d $debian/tree ]] || return 0
    if [[ -n $locked ]]; then
        versions_in "$locked" >"$work/locked"
        fetch_debian_now --locked "$work/locked"
    elif ! unpack_copy "$copy"; then
        fetch_debian_now
        keep_copy "$copy"
    fi
    key=debian-$wanted-$(versions_in "$work/debian/packages.txt" | sha256sum | cut -c 1-8)
    debian=$cache/$key
    if [[ -z $locked ]]; then
        rm -rf "$cache/debian-$wanted"-*
        echo "$(date +%F) $key" >"$today"
    fi
    rm -rf "$debian"
    mv "$work/debian" "$debian"
}

# Fetches the packages into $work/debian: packages.txt and tree/.
fetch_debian_now() { # OPTION...
    image_build/debian.sh "$@" ${firmware:+--firmware "$firmware"} ${mirror:+--mirror "$mirror"} "$work/debian"
    mkdir "$work/debian/tree"
    unpack_tar "$work/debian/tree" --exclude=./dev --exclude=./proc --exclude=./sys <"$work/debian/debian.tar"
    rm "$work/debian/debian.tar"
}

unpack_tar() { tar -C "$1" -x --no-same-owner --no-same-permissions "${@:2}"; } # FOLDER OPTION...

# Unpacks a copy into $work/debian. Returns false if there is none, or if it is damaged.
unpack_copy() { # COPY
    [[ -e $1 ]] || return 1
    mkdir "$work/debian"
    ! zstd -dcq "$1" 2>/dev/null | unpack_tar "$work/debian" 2>/dev/null || return 0
    rm -rf "$work/debian" "$1"
    return 1
}

# Makes a copy of $work/debian, and removes those of other days. If that fails, for example on a full disk, there is no copy.
keep_copy() { # COPY
    mkdir -p "${1%/*}" 2>/dev/null && tar -C "$work/debian" -c . | zstd -1 -q >"$work/copy" || return 0
    rm -f "${1%-????-??-??.tar.zst}"-*
    mv "$work/copy" "$1" || rm -f "$1"
}

# Name and version of each package in a packages.txt, sorted.
versions_in() { sed '/^#/d; /^$/d' "$1" | cut -d ' ' -f 1,2 | sort -u; }

unpack_ours() {
    local name deb
    if [[ -z $packages ]]; then
        packages=$cache/packages
        image_build/packages --out "$packages"
    fi
    mkdir "$work/ours"
    for name in frustumscreen-base frustumscreen; do
        deb=("$packages/${name}"_*.deb)
        [[ ${#deb[@]} == 1 && -e ${deb[0]} ]] || fail "--packages: $packages has not one package $name; ./image_build/packages makes it"
        check_needs "${deb[0]}"
        image_build/contents/unpack_deb.sh "${deb[0]}" "$work/ours"
        mkdir -p "$work/packages" && cp "${deb[0]}" "$work/packages/"
    done
}

# Our package's dependencies must be among the image's Debian packages.
check_needs() {
    local one need word missing=()
    while IFS= read -r need; do
        for one in ${need//|/ }; do # one of several alternatives is enough; a version in brackets is not a name
            word=${one%%:*}
            [[ $word =~ ^[a-z0-9][a-z0-9+.-]+$ ]] || continue
            [[ $word != frustumscreen* ]] || continue 2
            ! grep -q -e "^$word " "$debian/packages.txt" || continue 2
        done
        missing+=("$need")
    done < <(dpkg-deb -f "$1" Depends | tr ',' '\n')
    ((${#missing[@]} == 0)) || fail "${1##*/} needs${missing[*]}, which packages.conf does not bring: add it there"
}

# Bakes the exhibit's own words with speech, in all languages, with --quick only in English. They are kept until the bake changes.
bake_words() {
    local deb=("$packages"/frustumscreen-bake_*.deb) languages=()
    [[ -e ${deb[0]} ]] || fail "--packages: $packages has no frustumscreen-bake, which bakes the exhibit's words; ./image_build/packages makes it"
    ((level > 1)) || languages=(--languages en)
    words=$cache/words-$(sha256sum "${deb[0]}" | cut -c 1-16)-${#languages[@]}.fswords
    [[ ! -e $words ]] || return 0
    dpkg-deb -x "${deb[0]}" "$work/bake"
    "$work/bake/usr/bin/frustumscreen-bake" --words "${languages[@]}" -o "$work/words" >"$work/words.log" 2>&1 ||
        { cat "$work/words.log" >&2; fail "the exhibit's words could not be baked"; }
    mv "$work/words" "$words"
}

make_root() {
    local root=$work/root lists=() name unit unpacked=$debian/tree/unpacked
    [[ -z $firmware ]] || lists=("image_build/files.$firmware.list")
    mkdir "$root"
    image_build/lean.py "$root" "$work/kept" --from "$work/ours" --from "$debian/tree" --from "$unpacked" --kernel "$unpacked" \
        --files image_build/files.list "${lists[@]}" --modules image_build/modules.list \
        ${firmware:+"image_build/modules.$firmware.list"}
    find "$root" -type f -perm /6000 -exec chmod ug-s {} + # removes setuid and setgid: no program gives its user more rights
    cp -R image_build/files/. "$root/"
    [[ -z $update_ca ]] || install -m 644 "$update_ca" "$root/etc/rauc/keyring.pem"
    mkdir -p "$root"/{dev,proc,sys,run,tmp,var,data,efi,etc/frustumscreen,etc/systemd/system}
    : >"$root/etc/machine-id" # the first start makes it (initrd/init)
    rm -f "$root/usr/lib/os-release"
    {
        cat "$debian/tree/usr/lib/os-release"
        printf 'IMAGE_ID=frustumscreen\nIMAGE_VERSION=%s\n' "$version"
    } >"$root/usr/lib/os-release"
    ln -sf ../usr/lib/os-release "$root/etc/os-release"
    systemd-sysusers --root="$root" 2>"$work/users.log" || { cat "$work/users.log" >&2; fail "the users could not be made"; }
    chmod 600 "$root"/etc/{shadow,gshadow} # so that a build without root can read them into the image
    rm -f "$root"/etc/.pwd.lock "$root"/etc/{passwd,group,shadow,gshadow}-
    name=$(awk -F: '$3 > 127 && $3 < 65534 {print $1}' "$root/etc/passwd" "$root/etc/group")
    [[ -z $name ]] || fail "files/usr/lib/sysusers.d/00-image.conf gives no number to: ${name//$'\n'/, }"
    enable_units "$root"
    settings_of_image "$root"
    while read -r name; do # otherwise a new version of a library could slow starts unnoticed
        [[ -e $root/$name ]] || fail "files/usr/share/frustumscreen/read_ahead names /$name, which the root does not have; name what took its place"
    done <"$root/usr/share/frustumscreen/read_ahead"
    find "$root" -type f -printf '%s\t%P\n' | sort -k 2 | awk -F '\t' -v OFS='\t' \
        'NR == FNR { known[$3]; next } !($2 in known) { print $1, "what the image adds: words, units, users, indexes of modules", $2 }' \
        "$work/kept" - >"$work/added"
    cat "$work/added" >>"$work/kept"
}

enable_units() {
    local root=$1/etc/systemd/system target unit
    ln -s /usr/lib/systemd/system/multi-user.target "$root/default.target"
    while read -r target unit; do
        mkdir -p "$root/$target.wants"
        ln -s "/usr/lib/systemd/system/$unit" "$root/$target.wants/$unit"
    done <<'UNITS'
sysinit.target systemd-journald.service
sysinit.target systemd-udevd.service
sysinit.target systemd-udev-trigger.service
sysinit.target systemd-tmpfiles-setup.service
sysinit.target systemd-tmpfiles-setup-dev.service
sysinit.target kmod-static-nodes.service
sysinit.target systemd-sysctl.service
sysinit.target systemd-random-seed.service
sockets.target systemd-journald.socket
sockets.target systemd-journald-dev-log.socket
sockets.target systemd-udevd-control.socket
sockets.target systemd-udevd-kernel.socket
multi-user.target frustumscreen.service
multi-user.target frustumscreen-watchdog.service
multi-user.target frustumscreen-grow.service
multi-user.target frustumscreen-good.timer
multi-user.target frustumscreen-settings-proved.service
multi-user.target frustumscreen-next-try.timer
multi-user.target frustumscreen-no-card.timer
boot-complete.target frustumscreen-good.service
UNITS
    mkdir -p "$root/boot-complete.target.requires"
    mv "$root/boot-complete.target.wants/frustumscreen-good.service" "$root/boot-complete.target.requires/"
    rmdir "$root/boot-complete.target.wants"
}

# The shipped settings simulate devices; a kiosk has real ones.
settings_of_image() {
    local file=$1/usr/share/frustumscreen/kiosk.toml
    sed -f image_build/settings.sed "$file" >"$work/kiosk.toml"
    install -m 644 "$words" "$1/usr/share/frustumscreen/words.fswords"
    rm "$file" # a hard link to the package's file, which must not change
    install -m 644 "$work/kiosk.toml" "$file"
    install -m 644 "$work/kiosk.toml" "$1/etc/frustumscreen/kiosk.toml"
    # Runs with this machine's libraries, which are of the same Debian.
    sed "s|\"/usr/share/|\"$1/usr/share/|" "$work/kiosk.toml" >"$work/checked.toml"
    "$1/usr/bin/frustumscreen" config --config "$work/checked.toml" --json >/dev/null || fail "settings.sed makes settings that are wrong"
}

# Makes a slot's contents: the root, then verity's header and hashes, then the code that corrects damaged blocks.
make_slot() {
    local slot=$work/slot blocks formatted
    # Root owns all files in the image; files of other users are made at each start.
    env -u SOURCE_DATE_EPOCH mksquashfs "$work/root" "$slot" -quiet -no-progress -comp zstd -Xcompression-level "$level" -b 256K -all-root -no-xattrs \
        -mkfs-time "$SOURCE_DATE_EPOCH" -all-time "$SOURCE_DATE_EPOCH" -reproducible -exit-on-error >/dev/null
    blocks=$(($(stat -c %s "$slot") / 4096))
    (($(stat -c %s "$slot") % 4096 == 0)) || fail "the root's file system does not end with a block of 4096 bytes"
    salt=$(sha256sum "$slot" | cut -c 1-64)
    veritysetup format "$slot" "$slot" --data-blocks=$blocks --hash-offset=$((blocks * 4096)) --salt="$salt" \
        --uuid="$(uuid_of "$salt")" >/dev/null
    hash_blocks=$(($(stat -c %s "$slot") / 4096 - blocks - 1))
    formatted=$(veritysetup format "$slot" "$slot" --data-blocks=$blocks --hash-offset=$((blocks * 4096)) --salt="$salt" \
        --uuid="$(uuid_of "$salt")" --fec-device="$slot" --fec-offset=$(((blocks + 1 + hash_blocks) * 4096)) --fec-roots=2)
    root_hash=$(sed -n 's/^Root hash:[[:space:]]*//p' <<<"$formatted")
    root_blocks=$blocks
    [[ ${#root_hash} == 64 ]] || fail "veritysetup has not said the root's hash"
}

make_kernel_image() {
    local initrd=$work/initrd unpacked=$debian/tree/unpacked kernel
    kernel=$(ls "$unpacked/lib/modules")
    image_build/initrd.sh "$debian/tree" "$work/root" "$level" "$initrd"
    # console=ttyS0: the messages of the kernel and the service manager at a restart go to a serial line, which a PC need not have.
    # Otherwise the kernel would write them onto the table as soon as the exhibit has released the screen.
    # no_timer_check: at the start the kernel waits some 60 ms of the processor's clock for four ticks of the timer, and panics without
    # them ("IO-APIC + timer doesn't work!"). The ticks can also be missing because an emulated processor stops on a busy host.
    # watchdog.stop_on_reboot=0: by default, drivers stop the hardware's watchdog before the kernel restarts the machine, so a restart
    # that hangs would never end.
    {
        printf '%s ' quiet loglevel=3 console=ttyS0 lockdown=integrity panic=5 oops=panic sysctl.kernel.sysrq=0 vt.global_cursor_default=0 \
            gpt i8042.nokbd i8042.noaux no_timer_check watchdog.stop_on_reboot=0 net.ifnames=0 systemd.gpt_auto=0 systemd.import_credentials=0 systemd.show_status=0
        printf 'frustumscreen.root_hash=%s frustumscreen.root_blocks=%d frustumscreen.hash_blocks=%d frustumscreen.salt=%s' \
            "$root_hash" "$root_blocks" "$hash_blocks" "$salt"
    } >"$work/cmdline"
    put_together "$initrd" "$work/kernel.efi"
    if $test_image; then
        image_build/test_agent.sh "$debian/tree" "$work/root" "$work/extra.cpio"
        cat "$initrd" "$work/extra.cpio" >"$work/agent_initrd"
        put_together "$work/agent_initrd" "$work/agent.efi"
    fi
    cp "$unpacked/usr/lib/systemd/boot/efi/systemd-bootx64.efi" "$work/boot.efi"
    [[ -z $keys ]] || sign "$work/boot.efi"
}

# Makes a kernel image with the given initrd; all other parts are the same. It reads make_kernel_image's variables.
put_together() { # INITRD OUT
    image_build/kernel_image.py --stub "$unpacked/usr/lib/systemd/boot/efi/linuxx64.efi.stub" \
        --os-release "$work/root/usr/lib/os-release" --command-line "$work/cmdline" \
        --linux "$unpacked/boot/vmlinuz-$kernel" --initrd "$1" "$2"
    [[ -z $keys ]] || sign "$2"
}

sign() { # FILE. The signature has the time of the commit, so that the bytes are always the same.
    faketime -f "@$(date -u -d "@$SOURCE_DATE_EPOCH" '+%Y-%m-%d %H:%M:%S')" \
        sbsign --key "$keys/db.key" --cert "$keys/db.crt" --output "$1.signed" "$1" 2>"$work/sbsign.log" ||
        { cat "$work/sbsign.log" >&2; fail "sbsign could not sign with the keys in $keys"; }
    mv "$1.signed" "$1"
}

make_disk() {
    image_build/disk.sh --version "$version" --data "$data_size" "$work/boot.efi" "$work/kernel.efi" "$work/slot" "$work/disk"
    if $test_image; then
        mkdir -p "$out/as_shipped"
        mv "$work/disk" "$out/as_shipped/frustumscreen.raw"
        mv "$work/agent.efi" "$work/kernel.efi"
        image_build/disk.sh --version "$version" --data "$data_size" "$work/boot.efi" "$work/kernel.efi" "$work/slot" "$work/disk"
    fi
    rm -f "$out"/frustumscreen_*.{slot,efi} # files of other versions
    mv "$work/disk" "$out/frustumscreen.raw"
    cp "$work/kiosk.toml" "$out/" # for a technician to begin with
    mv "$work/slot" "$out/frustumscreen_$version.slot"
    mv "$work/kernel.efi" "$out/frustumscreen_$version.efi"
    cp "$work/kept" "$out/kept.tsv"
    cp "$debian/packages.txt" "$out/"
    rm -rf "$out/packages" && mv "$work/packages" "$out/"
    echo "$root_hash" >"$out/root_hash"
}

# Keeps the packages' data beside the image, and makes the bill of materials, the licences and why.txt from these data and the image.
say_what_is_in_it() {
    image_build/contents/keep_provenance.py "$out/provenance" --compiled-in image_build/contents/compiled_in.list \
        --tree ours="$work/ours" --tree debian="$debian/tree" --tree unpacked="$debian/tree/unpacked"
    image_build/contents/write_bill.py "$out"
    image_build/why "$out" >"$out/why.txt"
}

compress() { zstd -q -f -3 --single-thread --sparse "$out/frustumscreen.raw" -o "$out/frustumscreen.raw.zst"; }

say_sizes() {
    local file
    for file in frustumscreen.raw frustumscreen.raw.zst "frustumscreen_$version.slot" "frustumscreen_$version.efi"; do
        printf '%6d MB  %s\n' $(($(stat -c %s "$out/$file") / 1000000)) "$out/$file"
    done
    printf 'root hash %s\n' "$root_hash"
}
