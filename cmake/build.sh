#!/usr/bin/env bash
# Configures a preset where needed, and builds it or some of its targets; usage below. On a terminal ninja shows its progress;
# elsewhere a line every 20 s does, and the whole log is printed only if something fails.
#
# In a new build folder, a part named by --without is left out, and its packages are not needed. A folder that has such a part keeps
# it, and a folder that lacks a wanted part gets it; neither builds anything twice.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
presets=(release debug asan tsan fuzz coverage odr)
usage="usage: cmake/build.sh $(IFS='|' && echo "${presets[*]}") [--without tests|window|bench]... [TARGET...]

Configures build/PRESET where needed, and builds it or some of its targets."
if [[ ${1-} == -h || ${1-} == --help ]]; then
    echo "$usage"
    exit 0
fi
preset=${1-}
if [[ -z $preset || " ${presets[*]} " != *" $preset "* ]]; then
    echo "$usage" >&2
    exit 2
fi
shift
declare -A wanted=([BUILD_TESTING]=ON [FRUSTUMSCREEN_WINDOW]=ON [FRUSTUMSCREEN_BENCH]=ON)
while [[ ${1-} == --without ]]; do
    case "$2" in
        tests) wanted[BUILD_TESTING]=OFF ;;
        window) wanted[FRUSTUMSCREEN_WINDOW]=OFF ;;
        bench) wanted[FRUSTUMSCREEN_BENCH]=OFF ;;
        *)
            echo "build.sh: there is no part '$2'; the parts are tests, window and bench" >&2
            exit 2
            ;;
    esac
    shift 2
done
targets=()
if (($# > 0)); then
    targets=(--target "$@")
fi

folder=build/$preset
log=build/$preset.log
mkdir -p build
# Ends when the process that started it has ended.
say_progress() {
    local step
    while sleep 20 >/dev/null 2>&1 && kill -0 $$ 2>/dev/null; do
        step=$(grep -o '^\[[0-9]*/[0-9]*\]' "$log" | tail -n 1 || true)
        printf '   %s of the build, %d s\n' "${step:-at the beginning}" "$SECONDS"
    done
}
quietly() {
    say_progress &
    local progress=$! status=0
    "$@" >"$log" 2>&1 || status=$?
    kill "$progress"
    if ((status != 0)); then
        cat "$log" >&2
    fi
    return "$status"
}

# If ccache is installed, it finds the objects of another clone on this machine. The build does not depend on it.
launcher=$(command -v ccache || true)
timed="$PWD/cmake/timed"
export CMAKE_{C,CXX}_COMPILER_LAUNCHER="$timed;compile${launcher:+;$launcher}" # for a new build folder
export CMAKE_{C,CXX}_LINKER_LAUNCHER="$timed;link"
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
export CCACHE_INODECACHE=1 # otherwise every hit reads and hashes the precompiled headers, 110 MB

options=()
if [[ -z $launcher ]] && grep -qs '^CMAKE_CXX_COMPILER_LAUNCHER:.*ccache' "$folder/CMakeCache.txt"; then
    options+=(-DCMAKE_{C,CXX}_COMPILER_LAUNCHER="$CMAKE_CXX_COMPILER_LAUNCHER")
fi
for option in "${!wanted[@]}"; do
    if [[ ! -f $folder/build.ninja || ! -f $folder/CMakeCache.txt ]]; then
        options+=("-D$option=${wanted[$option]}")
    elif [[ ${wanted[$option]} == ON ]] && ! grep -q "^$option:BOOL=ON$" "$folder/CMakeCache.txt"; then
        options+=("-D$option=ON")
    fi
done
if ((${#options[@]} > 0)) || [[ CMakePresets.json -nt $folder/build.ninja ]]; then
    if ! quietly cmake --preset "$preset" "${options[@]}"; then
        if ((${#options[@]} > 0)); then
            rm -f "$folder/CMakeCache.txt" # otherwise the next command would keep these options
        fi
        echo "build.sh: './setup.sh window tests' installs the packages of all parts; for the preset fuzz, './setup.sh fuzz'" >&2
        exit 1
    fi
fi
if [[ -t 1 ]]; then
    cmake --build --preset "$preset" "${targets[@]}"
else
    quietly cmake --build --preset "$preset" "${targets[@]}"
fi
