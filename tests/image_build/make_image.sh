#!/usr/bin/env bash
# Makes the kiosk's image for tests, out/image/test, from the files below, which it makes first. The image is kept until its inputs change.
#
# build/image/packages     our Debian packages
# build/image/test_keys    update.key and update.crt: the key that signs updates for this image
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
./setup.sh hil kiosk window packages image
image_build/packages --quick --out build/image/packages
keys=build/image/test_keys
if [[ ! -e $keys/update.crt ]]; then
    mkdir -p $keys
    openssl req -x509 -newkey rsa:3072 -nodes -subj /CN=update -days 7300 -keyout $keys/update.key -out $keys/update.crt 2>/dev/null
fi
made_of=$(find image_build tests/hil/guest/etc/frustumscreen build/image/packages/*.deb $keys/update.crt -type f ! -path '*/__pycache__/*' \
    -exec sha256sum {} + | LC_ALL=C sort | sha256sum)
image=out/image/test
if [[ $(cat $image/made_of 2>/dev/null) != "$made_of" ]]; then
    rm -rf $image
    image_build/build --test --quick --packages build/image/packages --update-ca $keys/update.crt
    echo "$made_of" >$image/made_of
fi
