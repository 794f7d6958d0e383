#!/usr/bin/env bash
# Draws a fixed set of pictures with the programs of one build: two artifacts in both set-ups at 20 poses and
# three techniques, the visitor's view, captions, languages, fades, attract mode and the alignment pattern. Two
# builds that draw the same pictures leave folders that are equal byte for byte:
#
#   tests/house/picture_set.sh BIN FOLDER [BAKER]    BIN: the folder of the programs; FOLDER: is replaced; BAKER: the folder of the
#                                                    programs that bake the packs, if it is not BIN
#   diff -r FOLDER OTHER_FOLDER
set -euo pipefail
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
bin=$(realpath "$1") folder=$2
rm -rf "$folder"
mkdir -p "$folder"
folder=$(realpath "$folder")
packs=$folder/packs
"$root/tests/hil/bake_packs.sh" "$(realpath "${3:-$1}")" "$packs"

# Keeps pictures and counts: all columns except the time that a frame took.
keep() {
    cut -d , -f 1,2,4- "$1/frames.csv" >"$1/counts.csv"
    rm "$1/frames.csv"
}

for setup in kiosk near; do
    poses=$folder/$setup.poses.csv
    "$bin/frustumscreen-poses" simulate --config "$root/config/$setup.toml" --seed 7 --seconds 2 --hz 10 -o "$poses"
    for pack in amphora nautilus-cup; do
        for technique in finest level0 relief; do
            for view in projector visitor; do
                out=$folder/$setup.$pack.$technique.$view
                "$bin/frustumscreen" render --config "$root/config/$setup.toml" --pack "$packs/$pack.fspack" \
                    --poses "$poses" --technique "$technique" --view "$view" --width 640 --height 400 --out "$out" >/dev/null
                keep "$out"
            done
        done
    done
done

# The live exhibit on a simulated clock: presses and fades, the language, rest, attract mode; then the pattern.
settings=$folder/live.toml
cat >"$settings" <<END
[projector]
width = 640
height = 400
fx = 890.0
refresh_hz = 20.0
[tracker]
kind = "simulated"
[panel]
kind = "scripted"
script = [ { at_s = 1.0, button = 1 }, { at_s = 2.5, button = 2 }, { at_s = 4.0, button = 0 } ]
[exhibit]
packs = ["packs/amphora.fspack", "packs/nautilus-cup.fspack"]
captions = true
END
live() {
    local out=$folder/$1
    shift
    "$bin/frustumscreen" run --config "$settings" --headless --fast --stills 64 --out "$out" "$@" >/dev/null
    keep "$out"
}
live presses --seconds 6 --technique level0
live full_redraw --seconds 6 --technique level0 --full-redraw
live soak --seconds 6 --technique level0 --soak 12
live pattern --seconds 1 --pattern
# The prop is lost for five seconds.
{
    echo t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok
    for ((ms = 0; ms < 8000; ms += 50)); do
        echo "$((ms * 1000)),1,0.0$((ms / 1000)),-0.02,0,1,0,0,0,$((ms < 1000 || ms >= 6000))"
    done
} >"$folder/lost.csv"
sed -i 's/^kind = "simulated"/kind = "replay"\nposes = "lost.csv"/' "$settings"
live attract --seconds 7.9 --technique level0
rm -r "$packs"
