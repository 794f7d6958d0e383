#!/usr/bin/env bash
# Links every program with the preset odr, in which GCC compares the definitions of a type in all files of a program and refuses two
# different ones. First, as a control, a program with two definitions must not link.
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
