#!/usr/bin/env bash
# Configures (once) and builds a preset, or some of its targets: build.sh release|debug|asan|tsan|fuzz
# [TARGET...]. On a terminal ninja shows the progress; elsewhere it prints one line every 20 s, and the whole
# log only after a failure.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=$1
shift
targets=()
if (($# > 0)); then
    targets=(--target "$@")
fi

log=build/$preset.log
mkdir -p build
# Ends with the process that started it.
say_progress() {
    local step
    while sleep 20 >/dev/null 2>&1 && kill -0 $$ 2>/dev/null; do
        step=$(grep -o '^\[[0-9]*/[0-9]*\]' "$log" | tail -n 1 || true)
        printf '   %s of the build, %d s\n' "${step:-at the beginning}" "$SECONDS"
    done
}
quietly() {
    say_progress &
    local progress=$!
    if ! "$@" >"$log" 2>&1; then
        kill "$progress"
        cat "$log" >&2
        exit 1
    fi
    kill "$progress"
}
if [[ ! -f build/$preset/build.ninja || CMakePresets.json -nt build/$preset/build.ninja ]]; then
    quietly cmake --preset "$preset"
fi
if [[ -t 1 ]]; then
    cmake --build --preset "$preset" "${targets[@]}"
else
    quietly cmake --build --preset "$preset" "${targets[@]}"
fi
