#!/bin/sh
# Unpacks a package below a folder, and enters it into a dpkg data base there (var/lib/dpkg), in which image_build/why looks up the
# package of a file. No script of the package runs.
#
#   unpack_deb.sh DEB FOLDER
set -eu
deb=$1 folder=$2
info=$folder/var/lib/dpkg/info
mkdir -p "$info"
dpkg-deb -x "$deb" "$folder"
{
    dpkg-deb -f "$deb"
    echo
} >>"$folder/var/lib/dpkg/status"
dpkg-deb --fsys-tarfile "$deb" | tar -t | sed 's#^\./#/#; s#/$##' >"$info/$(dpkg-deb -f "$deb" Package).list"
