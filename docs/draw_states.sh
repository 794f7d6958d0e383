#!/usr/bin/env bash
# Writes docs/states.md, and draws docs/states.svg with Graphviz (Debian's package graphviz), from the program's own table.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bin=build/release/bin
if ! command -v dot >/dev/null; then
    echo "draw_states.sh: dot is not installed; install Debian's package graphviz" >&2
    exit 1
fi
"$bin/frustumscreen" states >docs/states.md
"$bin/frustumscreen" states --dot | dot -Tsvg >docs/states.svg
