#!/usr/bin/env bash
# Lists the ten slowest compilations, links and tests of a run, and the sums of each kind.
#
#   tests/house/list_slowest.sh TIMES    TIMES: the file that cmake/timed has written
set -euo pipefail
[[ -s $1 ]] || exit 0
printf '== slowest   wall  processor\n'
sort -rn "$1" | awk -F '\t' 'NR <= 10 { printf "   %11.1f s %8.1f s   %-8s%s\n", $1, $2, $3, $4 }'
awk -F '\t' '{ ++count[$3]; wall[$3] += $1; processor[$3] += $2 }
    END {
        for (kind in count) {
            printf "   %11.1f s %8.1f s   all %d of kind %s\n", wall[kind], processor[kind], count[kind], kind
        }
    }' "$1" | sort -k 5
