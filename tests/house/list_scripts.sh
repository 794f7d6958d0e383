#!/usr/bin/env bash
# Lists the scripts of the repository in one language, by their first line or their name.
#
#   tests/house/list_scripts.sh shell|python
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print0 | xargs -0 awk -v wanted="$1" '
    FNR == 1 {
        language = ""
        if (/^#!.*[\/ ](ba|da)?sh( -[a-z]+)?$/ || FILENAME ~ /\.sh$/) {
            language = "shell"
        } else if (/^#!.*python3/ || FILENAME ~ /\.py$/) {
            language = "python"
        }
        if (language == wanted) {
            print substr(FILENAME, 3)
        }
        nextfile
    }' | sort
