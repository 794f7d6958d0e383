#!/usr/bin/env bash
# Links every program with the preset odr: there GCC compares what all files of a program say of a type, and refuses two
# definitions of one name. Before that, a program that has two must not link.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..

seeded=$(mktemp -d)
trap 'rm -rf "$seeded"' EXIT
cp -r "$here/two_definitions/." "$root/CMakePresets.json" "$seeded"
(cd "$seeded" && cmake --preset odr) >"$seeded/log" 2>&1
if LC_ALL=C cmake --build "$seeded/build/odr" >>"$seeded/log" 2>&1 ||
    ! grep -q "type .* violates the C++ One Definition Rule" "$seeded/log"; then
    cat "$seeded/log"
    echo "one_definition.sh: the preset odr does not see that two_definitions::Box is defined twice" >&2
    exit 1
fi

"$root/cmake/build.sh" odr --without tests
