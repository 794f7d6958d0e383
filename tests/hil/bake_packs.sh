#!/usr/bin/env bash
# Bakes the two artifacts that the guest shows (one of them for a cube in the hand too), and the exhibit's own words in two languages.
# With few triangles and small images this takes seconds.
#
#   bake_packs.sh BIN FOLDER    BIN: the folder of our programs; a file that is newer than the programs and this script is kept
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
    "$bin/frustumscreen-bake" --words --languages en,de -o "$words" & # it uses one core, while the packs are baked
    baking=$!
fi
bake() { # ARTIFACT PACK OPTION...
    local artifact=$1 pack=$folder/$2.fspack title=$2
    shift 2
    if ! stays "$pack" "$bin/frustumscreen-bake" "$bin/frustumscreen-artifact"; then
        "$bin/frustumscreen-artifact" "$artifact" --triangles 2000 -o "$folder/$title.glb"
        "$bin/frustumscreen-bake" "$folder/$title.glb" -o "$pack" --size 256 --title "$title" --language en --language de "$@"
        rm "$folder/$title.glb"
    fi
}

bake amphora amphora
bake nautilus-cup nautilus-cup
bake amphora amphora-cube --prop cube
[[ -z $baking ]] || wait "$baking"
