#!/usr/bin/env bash
# Draws the README's pictures, docs/room.png and docs/visitor.webp, of the nautilus cup that ./run has baked; and
# docs/picture_steps.webp, of the same, which needs what ./test builds; and docs/hall.png and docs/room.svg of the example
# hall. The loop takes some minutes.
#   docs/draw_pictures.sh [steps|hall]    steps: picture_steps.webp alone, of the built-in artifact where ./run has baked none
#                                         hall: those of the example hall alone
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

# The picture from the low eye at the right, in which the prop is before the screen.
"$bin/frustumscreen" drawing --config config/hall.toml --sheet room -o docs/room.svg
"$bin/frustumscreen" render --config config/hall.toml --pack out/packs/amphora.fspack --poses config/hall/eyes.csv --view room \
    --width 520 --height 390 --out "$folder/hall"
cp "$folder/hall/frame_00002.png" docs/hall.png
if [[ ${1-} == hall ]]; then
    exit
fi

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
