#!/usr/bin/env bash
# Runs a test in a temporary folder of its own, and fails it if it leaves files there. CTest runs every test by this script.
#
#   tests/house/run_test.sh NAME COMMAND...
#
# $FRUSTUMSCREEN_UNDER has the words of a program under which the command runs, such as strace.
set -uo pipefail
TMPDIR=$(mktemp -d "${TMPDIR:-/tmp}/t.XXXXXX") || exit 1 # a short name: the path of a socket has 107 characters at most
export TMPDIR
chmod 1777 "$TMPDIR" # some tests act as another user
# Freed memory stays with the process (mallopt(3)). Otherwise tests that draw and fit spend up to a fifth of their time on getting the
# same pages from the kernel again, zeroed.
export MALLOC_TRIM_THRESHOLD_=1000000000 MALLOC_MMAP_THRESHOLD_=1000000000
# espeak-ng connects to PulseAudio even where it writes to a pipe, and the library makes a folder for that. Where no session has one, it
# lies in TMPDIR, and its name in the home folder of the user: the first such test on a new machine would leave it.
export PULSE_RUNTIME_PATH=$TMPDIR/pulse
# Caches of libraries belong to this clone, not to the home folder, and Python leaves no bytecode beside its sources.
cache=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/out/test_cache
mkdir -p "$cache/mesa" "$cache/matplotlib"
chmod 1777 "$cache/mesa" "$cache/matplotlib" # some tests act as another user
export MESA_SHADER_CACHE_DIR=$cache/mesa MPLCONFIGDIR=$cache/matplotlib PYTHONDONTWRITEBYTECODE=1
export PATH=/usr/bin:/bin:$PATH # for Debian's Python; another one may lack its modules, and may start ten times slower
name=$1
shift
read -ra under <<<"${FRUSTUMSCREEN_UNDER-}"
unset FRUSTUMSCREEN_UNDER
"$(dirname "${BASH_SOURCE[0]}")/../../cmake/timed" test "$name" "${under[@]}" "$@"
status=$?
rmdir "$PULSE_RUNTIME_PATH" 2>/dev/null
left=$(cd "$TMPDIR" && find . -mindepth 1 -maxdepth 2)
rm -rf "$TMPDIR"
if [[ -n $left ]]; then
    printf '%s left these in the temporary folder:\n%s\n' "$name" "$left" >&2
    status=1
fi
exit "$status"
