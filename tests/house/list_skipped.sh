#!/usr/bin/env bash
# Lists the skipped tests and the reasons, because ctest counts a program as passed even if some of its tests were skipped.
#
#   tests/house/list_skipped.sh LOG    LOG: the tests' output, which ctest keeps in Testing/Temporary/LastTest.log
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
    # A Python program with verbosity=2; a test that has a description writes two lines.
    /^test_[^ ]+ \(/ { name = $1 }
    / \.\.\. skipped / && name != "" {
        reason = $0
        sub(/^.* \.\.\. skipped ./, "", reason)
        sub(/.$/, "", reason)
        lines[++count] = "   " name ": " reason
        name = reason = ""
    }
    END {
        if (count) {
            print "== " count (count == 1 ? " test was" : " tests were") " skipped"
        }
        for (k = 1; k <= count; ++k) {
            print lines[k]
        }
    }' "$1"
