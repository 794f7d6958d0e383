#!/usr/bin/env bash
# Bakes the two artifacts that the guest shows and the words that it says: few triangles, small images, in seconds.
#
#   bake_packs.sh BIN FOLDER    BIN: where our programs are; a pack newer than they are stays
set -euo pipefail
bin=$1 folder=$2
mkdir -p "$folder"
for name in amphora nautilus-cup; do
    pack=$folder/$name.fspack
    if [[ ! $pack -nt $bin/frustumscreen-bake || ! $pack -nt $bin/frustumscreen-artifact ]]; then
        "$bin/frustumscreen-artifact" "$name" --triangles 20000 -o "$folder/$name.glb"
        "$bin/frustumscreen-bake" "$folder/$name.glb" -o "$pack" --size 256 --title "$name" --language en
        rm "$folder/$name.glb"
    fi
done
words=$folder/words.fswords
if [[ ! $words -nt $bin/frustumscreen-bake ]]; then
    "$bin/frustumscreen-bake" --words --languages en -o "$words"
fi
