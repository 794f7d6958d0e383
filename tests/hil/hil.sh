#!/usr/bin/env bash
# ./test hil: installs what it needs, builds the programs that it needs, and runs the tests in an emulated machine.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$here/../.."

build=true
for option; do
    case "$option" in
        --list | --build | --build=* | -h | --help) build=false ;;
    esac
done
if $build; then
    ./setup.sh hil kiosk
    printf '== building (release)\n'
    cmake/build.sh release --without tests --without window \
        frustumscreen frustumscreen-pack frustumscreen-import frustumscreen-safe frustumscreen-watchdog frustumscreen-built-in \
        frustumscreen-bake frustumscreen-artifact
fi
exec tests/hil/run_tests.py "$@"
