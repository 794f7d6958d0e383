#!/usr/bin/env bash
# Runs a test in a temporary folder of its own, and fails it if something stays there. CTest runs every test through this.
#
#   tests/house/run_test.sh NAME COMMAND...
set -uo pipefail
TMPDIR=$(mktemp -d "${TMPDIR:-/tmp}/t.XXXXXX") || exit 1 # a short name: the path of a socket has 107 characters at most
export TMPDIR
chmod 1777 "$TMPDIR" # some tests act as another user
export PATH=/usr/bin:/bin:$PATH # Debian's Python: another one may lack its modules, and start ten times slower
"$(dirname "${BASH_SOURCE[0]}")/../../cmake/timed" test "$@"
status=$?
left=$(cd "$TMPDIR" && find . -mindepth 1 -maxdepth 2)
rm -rf "$TMPDIR"
if [[ -n $left ]]; then
    printf '%s left these in the temporary folder:\n%s\n' "$1" "$left" >&2
    status=1
fi
exit "$status"
