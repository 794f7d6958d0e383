#!/usr/bin/env bash
# Configures (once) and builds a preset: build.sh release|debug|asan|tsan|fuzz. Quiet unless something fails.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=$1

log=build/$preset.log
mkdir -p build
quietly() {
    if ! "$@" >"$log" 2>&1; then
        cat "$log" >&2
        exit 1
    fi
}
if [[ ! -f build/$preset/build.ninja || CMakePresets.json -nt build/$preset/build.ninja ]]; then
    quietly cmake --preset "$preset"
fi
if [[ -t 1 ]]; then
    cmake --build --preset "$preset"
else
    quietly cmake --build --preset "$preset"
fi
