# Builds and runs PROGRAM with the flags of pkg-config.
# usage: pkg_config.sh shared|static COMPILER PKG_CONFIG PREFIX WORK PROGRAM
set -eu
kind=$1 compiler=$2 pkg_config=$3 prefix=$4 work=$5 program=$6

rm -rf "$work"
mkdir -p "$work"
if [ "$kind" = static ]; then
    # As a static-only installation: given both, linkers prefer the shared library.
    cp -R "$prefix" "$work/prefix"
    prefix=$work/prefix
    find "$prefix" -name 'libperiodyn.so*' -exec rm {} +
    options=--static
else
    options=
fi

package=$(find "$prefix" -name periodyn.pc)
export PKG_CONFIG_PATH="${package%/*}"
# shellcheck disable=SC2046,SC2086 # flags are words
"$compiler" -std=c99 -Wall -Wextra -Wpedantic -Werror "$program" -o "$work/program" \
    $("$pkg_config" $options --cflags --libs periodyn)
LD_LIBRARY_PATH=$("$pkg_config" --variable=libdir periodyn) "$work/program"

# The right library is the one that is used.
if ldd "$work/program" | grep -q libperiodyn; then used=shared; else used=static; fi
[ "$used" = "$kind" ] || { echo "linked with the $used library"; exit 1; }
