#!/usr/bin/env bash
# Bakes the two artifacts that the guest shows and the words that it says, in two languages: few triangles, small images, in
# seconds.
#
#   bake_packs.sh BIN FOLDER    BIN: where our programs are; a file newer than they and this script stays
set -euo pipefail
bin=$1 folder=$2
mkdir -p "$folder"

stays() { # FILE PROGRAM...
    local file=$1 made_by
    shift
    for made_by in "${BASH_SOURCE[0]}" "$@"; do
        [[ $file -nt $made_by ]] || return 1
    done
}

words=$folder/words.fswords
baking=
if ! stays "$words" "$bin/frustumscreen-bake"; then
    "$bin/frustumscreen-bake" --words --languages en,de -o "$words" & # one core's work, beside the packs
    baking=$!
fi
for name in amphora nautilus-cup; do
    pack=$folder/$name.fspack
    if ! stays "$pack" "$bin/frustumscreen-bake" "$bin/frustumscreen-artifact"; then
        "$bin/frustumscreen-artifact" "$name" --triangles 2000 -o "$folder/$name.glb"
        "$bin/frustumscreen-bake" "$folder/$name.glb" -o "$pack" --size 256 --title "$name" --language en --language de
        rm "$folder/$name.glb"
    fi
done
[[ -z $baking ]] || wait "$baking"
