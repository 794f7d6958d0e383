#!/usr/bin/env bash
# ./test image: makes the image for tests, and starts it in an emulated PC with UEFI; usage below.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$here/../.."
usage="usage: ./test image [--all|--but-shipped] [NAME...]
       ./test image --cuts [OPTION...]
       ./test image --start-time [OPTION...]

  --all          runs the long tests too
  --but-shipped  without the start that './test hil' makes too, of the disk as it is shipped
  NAME           a test, as unittest names it, such as test_start.Start.test_first_start; without a name, all tests
  --cuts         tests power cuts instead: './test image --cuts --help'
  --start-time   measures how long starts take instead: './test image --start-time --help'"
for option; do # first, so that help needs no build
    if [[ $option == --help || $option == -h ]]; then
        case "$1" in
            --cuts) exec /usr/bin/python3 "$here/../cuts/cuts.py" --help ;;
            --start-time) exec "$here/start_time.py" --help ;;
        esac
        echo "$usage"
        exit 0
    fi
done
cuts=false
if [[ ${1-} == --cuts ]]; then
    cuts=true
    shift
elif [[ ${1-} == --start-time ]]; then
    start_time=true
    shift
elif [[ ${1-} == --all ]]; then
    export FRUSTUMSCREEN_IMAGE_ALL=1
    shift
elif [[ ${1-} == --but-shipped ]]; then
    export FRUSTUMSCREEN_IMAGE_BUT_SHIPPED=1
    shift
fi
./tests/image_build/make_image.sh
FRUSTUMSCREEN_IMAGE_PACKAGES=$(readlink -f build)/image/packages
keys=build/image/test_keys
if $cuts || [[ ${FRUSTUMSCREEN_IMAGE_ALL-} ]]; then # these tests also need an image to update to
    image_build/build --quick --test --packages "$FRUSTUMSCREEN_IMAGE_PACKAGES" --update-ca $keys/update.crt --version 99.0.0 --out out/image/next
    FRUSTUMSCREEN_IMAGE_NEXT=$(readlink -f out/image/next/test) FRUSTUMSCREEN_IMAGE_KEYS=$(readlink -f $keys)
    export FRUSTUMSCREEN_IMAGE_NEXT FRUSTUMSCREEN_IMAGE_KEYS
fi
if $cuts; then
    cmake/build.sh release frustumscreen-import frustumscreen-pack frustumscreen-bake frustumscreen-artifact
    tests/hil/bake_packs.sh build/release/bin build/hil/packs
    PYTHONDONTWRITEBYTECODE=1 exec /usr/bin/python3 tests/cuts/cuts.py "$@"
fi
FRUSTUMSCREEN_IMAGE=$(readlink -f out/image/test/frustumscreen.raw) FRUSTUMSCREEN_IMAGE_LOGS=$(readlink -f out/image)/logs
export FRUSTUMSCREEN_IMAGE FRUSTUMSCREEN_IMAGE_LOGS FRUSTUMSCREEN_IMAGE_PACKAGES PYTHONDONTWRITEBYTECODE=1
rm -rf "$FRUSTUMSCREEN_IMAGE_LOGS"
/usr/bin/python3 "$here/real_image_test.py" . out/image/test
cd "$here"
if [[ ${start_time-} ]]; then
    exec ./start_time.py "$@"
fi
if (($# > 0)); then
    exec /usr/bin/python3 -m unittest -v "$@"
fi
exec /usr/bin/python3 -m unittest discover -v
