#!/usr/bin/env bash
# ./test soak: makes the kiosk's image for tests, and runs the soak on it (docs/soak.md). Options are those of run_soak.py.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$here/../.."
for option; do
    if [[ $option == --help || $option == -h ]]; then
        FRUSTUMSCREEN_IMAGE='' exec "$here/run_soak.py" --help
    fi
done
tests/image_build/make_image.sh
printf '== building (release)\n'
cmake/build.sh release --without tests --without window frustumscreen-pack frustumscreen-poses frustumscreen-built-in
FRUSTUMSCREEN_IMAGE=$(readlink -f out/image/test/frustumscreen.raw)
export FRUSTUMSCREEN_IMAGE PYTHONDONTWRITEBYTECODE=1
exec "$here/run_soak.py" "$@"
