#!/usr/bin/env bash
# Draws the README's pictures, docs/room.png and docs/visitor.webp, of the nautilus cup that ./run has baked; and
# docs/picture_steps.webp, of the same, which needs what ./test builds; and docs/hall.png and docs/room.svg of the example
# hall; docs/windows.png of the amphora; and docs/site.webp of the hill town, which is baked as docs/sites.md says. The loops take
# some minutes.
#   docs/draw_pictures.sh [steps|hall|windows|site]    steps: picture_steps.webp alone, of the built-in artifact where ./run has baked
#                                                      none; hall, windows, site: those alone
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
pack=out/packs/nautilus-cup.fspack
draw_steps() {
    cmake/build.sh release draw_picture_steps >/dev/null
    build/release/tests/draw_picture_steps "$1" docs/picture_steps.webp
}
if [[ ${1-} == steps ]]; then
    [[ -f $pack ]] || pack=build/release/kiosk/built_in.fspack
    draw_steps "$pack"
    exit
fi
if [[ ! -f $pack ]]; then
    echo "draw_pictures.sh: $pack: there is no such file; run ./run first" >&2
    exit 1
fi
bin=build/release/bin
config=config/kiosk.toml
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The prop between two windows, which were pinned from the same eye.
draw_windows() {
    printf '%s\n' t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok 0,1,0,0.02,0,1,0,0,0,1 0,2,0,-0.42,0.62,1,0,0,0,1 >"$folder/eye.csv"
    sed 's/^\(width_m\|depth_m\) = .*/\1 = 0.18/' config/windows.toml >"$folder/windows.toml"
    "$bin/frustumscreen" render --config "$folder/windows.toml" --pack out/packs/amphora.fspack --poses "$folder/eye.csv" --view visitor \
        --pin 0.27,-0.05 --pin -0.27,-0.05 --width 520 --height 325 --out "$folder/windows"
    cp "$folder/windows/frame_00000.png" docs/windows.png
}

# The visitor of config/site.toml goes into the town.
draw_site() {
    "$bin/frustumscreen" run --config config/site.toml --headless --fast --seconds 14 --stills 56 --out "$folder/site"
    "$bin/frustumscreen-sheet" --config config/site.toml --frames "$folder/site" --animation docs/site.webp --animation-frames 56 \
        --closed --width 360 --height 225
}

case ${1-} in
    windows | site)
        "draw_$1"
        exit
        ;;
esac
# The picture from the low eye at the right, in which the prop is before the screen.
"$bin/frustumscreen" drawing --config config/hall.toml --sheet room -o docs/room.svg
"$bin/frustumscreen" render --config config/hall.toml --pack out/packs/amphora.fspack --poses config/hall/eyes.csv --view room \
    --width 520 --height 390 --out "$folder/hall"
cp "$folder/hall/frame_00002.png" docs/hall.png
if [[ ${1-} == hall ]]; then
    exit
fi

draw_windows
[[ ! -f out/packs/hill-town.fspack ]] || draw_site

# 10 s at 30 pictures a second: the prop turns once and slides in an eight, the eye goes to and fro, all back to the beginning.
awk 'BEGIN {
    pi = atan2(0, -1); count = 300
    print "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"
    for (k = 0; k < count; ++k) {
        a = 2 * pi * k / count; half_turn = (a + 0.35) / 2; t = int(k * 1e6 / 30 + 0.5)
        printf "%d,1,%.6f,%.6f,0,%.7f,0,0,%.7f,1\n", t, 0.07 * sin(a), 0.02 * sin(2 * a), cos(half_turn), sin(half_turn)
        printf "%d,2,%.6f,-0.55,0.5,1,0,0,0,1\n", t, 0.18 * sin(a)
    }
}' >"$folder/poses.csv"
"$bin/frustumscreen" render --config "$config" --pack "$pack" --poses "$folder/poses.csv" --out "$folder/frames"
"$bin/frustumscreen-sheet" --config "$config" --frames "$folder/frames" --poses "$folder/poses.csv" --room docs/room.png \
    --animation docs/visitor.webp --animation-frames 300 --closed --lossless --width 360 --height 225
draw_steps "$pack"
