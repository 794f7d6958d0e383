#!/usr/bin/env bash
# ./test hil: installs the packages and builds the programs that it needs, and runs the tests in an emulated machine. Without options it
# also starts the shipped image by UEFI.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$here/../.."

build=true
for option; do
    case "$option" in
        --list | -h | --help) build=false ;;
    esac
done
if $build; then
    tests/image_build/make_image.sh
fi
if (($# > 0)); then
    exec tests/hil/run_tests.py "$@"
fi
status=0
tests/hil/run_tests.py || status=$?
FRUSTUMSCREEN_IMAGE=$(readlink -f out/image/test/frustumscreen.raw) FRUSTUMSCREEN_IMAGE_LOGS=$(readlink -f out/hil)
export FRUSTUMSCREEN_IMAGE FRUSTUMSCREEN_IMAGE_LOGS PYTHONDONTWRITEBYTECODE=1
cd tests/image_build
/usr/bin/python3 -m unittest -v test_shipped.AsShipped.test_at_the_pictures_own_size || status=$?
exit "$status"
