#!/usr/bin/env bash
# ./test coverage: builds with gcov, runs the tests, and prints for each room which lines and branches they reached. The pages are in
# out/coverage.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
./setup.sh window kiosk tests coverage
cmake/build.sh coverage
find build/coverage -name '*.gcda' -delete # of the last run
status=0
ctest --preset coverage --parallel 5 || status=$?
mkdir -p out/coverage
echo '== reading what was reached'
gcovr --root . --object-directory build/coverage --filter app/ --filter firmware_host/ --filter assets_baked/ -j "$(nproc)" \
    --exclude-throw-branches --exclude-unreachable-branches --json-summary out/coverage/summary.json \
    --html-details out/coverage/index.html build/coverage >/dev/null
tests/coverage/rooms.py out/coverage/summary.json build/coverage/tests/layers/layers.txt | tee out/coverage/rooms.txt
echo '== the lines of each file are in out/coverage/index.html'
exit "$status"
