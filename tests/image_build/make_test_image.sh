#!/usr/bin/env bash
# Makes our packages, a key for updates, and the image for tests of both: build/image, out/image/test.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
packages=$(readlink -f build)/image/packages keys=build/image/test_keys
image_build/packages --out "$packages"
PYTHONPATH=tests/image_build PYTHONDONTWRITEBYTECODE=1 \
    python3 -c 'import pathlib, sys, updates; updates.make_key(pathlib.Path(sys.argv[1]), "update")' $keys
image_build/build --quick --test --packages "$packages" --update-ca $keys/update.crt
