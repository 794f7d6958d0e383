#!/usr/bin/env bash
# Says which tests were skipped, and why: ctest counts a program as passed of which some tests were.
#
#   tests/house/list_skipped.sh LOG    LOG: what the tests printed, as ctest keeps it in Testing/Temporary/LastTest.log
set -euo pipefail
awk '
    wants_reason && NF && !/^\[/ { reason = $0; wants_reason = 0 }
    /: Skipped$/ { wants_reason = 1; reason = "" }
    /^\[  SKIPPED \] .* \([0-9]+ ms\)$/ {
        name = $0
        sub(/^\[  SKIPPED \] /, "", name)
        sub(/ \([0-9]+ ms\)$/, "", name)
        lines[++count] = "   " name ": " (reason == "" ? "it does not say why" : reason)
        wants_reason = 0
        reason = ""
    }
    END {
        if (count) {
            print "== " count (count == 1 ? " test was" : " tests were") " skipped"
        }
        for (k = 1; k <= count; ++k) {
            print lines[k]
        }
    }' "$1"
