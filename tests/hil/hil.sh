#!/usr/bin/env bash
# ./test hil: installs what it needs, builds the programs that it needs, and runs the tests in an emulated machine.
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
exec tests/hil/run_tests.py "$@"
