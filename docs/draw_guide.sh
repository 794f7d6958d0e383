#!/usr/bin/env bash
# Draws those pictures of docs/guide that the programs make, in some seconds: the settings' drawings (docs/torch.svg too), the staff's
# picture, and a stick that is taken in. It needs what ./test builds. connections.svg and panel.svg are drawn by hand.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bin=$PWD/build/release/bin
built_in=$PWD/build/release/kiosk/built_in.fspack
guide=$PWD/docs/guide
if [[ ! -f $built_in ]]; then
    echo "draw_guide.sh: $built_in: there is no such file; run ./test first" >&2
    exit 1
fi
cmake/build.sh release draw_staff_picture draw_calibration_pictures >/dev/null
build/release/tests/draw_staff_picture "$guide"
"$bin/frustumscreen" drawing --config config/kiosk.toml -o "$guide/table.svg"
"$bin/frustumscreen" drawing --config config/kiosk.toml -o "$guide/prop.svg" --sheet prop
"$bin/frustumscreen" drawing --config config/torch.toml -o docs/torch.svg --sheet torch

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/tests/draw_calibration_pictures "$folder"
cp "$folder/calibrate_cross.png" "$folder/camera_rest.png" "$folder/eyes_cross.png" "$guide/"
cd "$folder"
# A stick with a pack that is signed and one that is not, taken in by the importer itself.
mkdir stick library keys
"$bin/frustumscreen-pack" keygen -o museum </dev/null 2>/dev/null >&2
cp museum.pub keys/
cp "$built_in" stick/amphora.fspack
cp "$built_in" stick/vase.fspack
"$bin/frustumscreen-pack" sign stick/amphora.fspack --key museum.key >/dev/null
"$bin/frustumscreen-import" --from stick --into library --keys keys --report report.json --id 1 >/dev/null 2>&1
"$bin/frustumscreen-bake" --words --languages en -o words.fswords --speech none >/dev/null 2>&1
cat >kiosk.toml <<END
[projector]
width = 1280
height = 800
[tracker]
kind = "none"
[exhibit]
packs = ["$built_in"]
library = "no_library"
words = "words.fswords"
import_report = "report.json"
[sound]
kind = "none"
END
"$bin/frustumscreen" run --config kiosk.toml --headless --seconds 6 --stills 4 --out stick_run >/dev/null 2>&1
cp stick_run/frame_00003.png "$guide/stick.png"
