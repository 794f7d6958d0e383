#!/usr/bin/env bash
# Takes from out/fuzz the few small inputs that, together with the named files of the corpora, reach the most code.
#
#   tests/fuzz/keep_found.sh [TARGET...]     after ./test fuzz
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

max_inputs=32 # inputs for each target; the merge writes those that reach the most code first
found_name='*/[0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f]*'

targets=("$@")
if ((${#targets[@]} == 0)); then
    for folder in out/fuzz/*/corpus; do
        folder=${folder%/corpus}
        targets+=("${folder##*/}")
    done
fi
for target in "${targets[@]}"; do
    corpus=tests/fuzz/corpus/$target
    mkdir -p "$corpus"
    find "$corpus" -type f -path "$found_name" -exec mv -t "out/fuzz/$target/corpus" {} +
    "build/fuzz/fuzz/frustumscreen_fuzz_$target" -set_cover_merge=1 -use_counters=0 -max_len=4096 -timeout=10 \
        "$corpus" "out/fuzz/$target/corpus" >"out/fuzz/$target/keep.log" 2>&1
    find "$corpus" -type f -path "$found_name" -printf '%T@ %p\n' | sort -n | tail -n +$((max_inputs + 1)) |
        cut -d ' ' -f 2- | xargs -r rm
    echo "$target: $(find "$corpus" -type f | wc -l) inputs, $(du -sh --apparent-size "$corpus" | cut -f 1)"
done
