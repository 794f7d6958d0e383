#!/usr/bin/env bash
# ./test image: makes the image for tests, and starts it in an emulated PC with UEFI.
#
#   run_tests.sh [--all] [NAME...]    --all: the long tests too; NAME: as unittest names them, such as test_start.Start.test_two_starts
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$here/../.."
if [[ ${1-} == --all ]]; then
    export FRUSTUMSCREEN_IMAGE_ALL=1
    shift
fi
./setup.sh hil kiosk image packages window
image_build/build --quick --test
FRUSTUMSCREEN_IMAGE=$(readlink -f out/image/test/frustumscreen.raw) FRUSTUMSCREEN_IMAGE_LOGS=$(readlink -f out/image)/logs
export FRUSTUMSCREEN_IMAGE FRUSTUMSCREEN_IMAGE_LOGS PYTHONDONTWRITEBYTECODE=1
rm -rf "$FRUSTUMSCREEN_IMAGE_LOGS"
cd "$here"
if (($# > 0)); then
    exec python3 -m unittest -v "$@"
fi
exec python3 -m unittest discover -v
