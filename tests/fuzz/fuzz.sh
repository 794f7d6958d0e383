#!/usr/bin/env bash
# Fuzzes each target for some seconds, two at a time; ./test fuzz builds them first.
#
#   tests/fuzz/fuzz.sh SECONDS [TARGET...]
#
# It begins with tests/fuzz/corpus/TARGET and keeps new inputs in out/fuzz/TARGET/corpus. An input that makes a
# target fail stays as out/fuzz/TARGET/crash-*, beside the log; the last lines of the output name it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds=$1
shift
programs=build/fuzz/fuzz
export ASAN_SYMBOLIZER_PATH=/usr/lib/llvm-14/bin/llvm-symbolizer
targets=("$@")
if ((${#targets[@]} == 0)); then
    for program in "$programs"/frustumscreen_fuzz_*; do
        target=${program##*/frustumscreen_fuzz_}
        [[ $target == seeds ]] || targets+=("$target")
    done
fi

fuzz() {
    local target=$1 folder=out/fuzz/$1
    mkdir -p "$folder/corpus"
    rm -f "$folder"/{crash,leak,oom,slow-unit,timeout}-*
    local options=(-seed=1 -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024
        -max_len=8192 -artifact_prefix="$folder/" -print_final_stats=1)
    if [[ -f tests/fuzz/$target.dict ]]; then
        options+=(-dict="tests/fuzz/$target.dict")
    fi
    if ! "$programs/frustumscreen_fuzz_$target" "${options[@]}" "$folder/corpus" "tests/fuzz/corpus/$target" \
        >"$folder/log" 2>&1; then
        echo "$target: FAILED, see $folder" >&2
        grep -E 'broken promise|runtime error|ERROR:|SUMMARY' "$folder/log" >&2 || true
        return 1
    fi
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/log") inputs," \
        "$(sed -n 's/.*cov: \([0-9]*\) .*/\1/p' "$folder/log" | tail -n 1) edges"
}

running=()
failed=0
for target in "${targets[@]}"; do
    fuzz "$target" &
    running+=($!)
    if ((${#running[@]} == 2)); then
        wait "${running[0]}" || failed=1
        running=("${running[1]}")
    fi
done
for process in "${running[@]}"; do
    wait "$process" || failed=1
done
exit "$failed"
