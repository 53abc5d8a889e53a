# Builds and runs program.cpp or program.f90 of SOURCES with the flags of pkg-config.
# usage: pkg_config_language.sh CXX|Fortran COMPILER PKG_CONFIG PREFIX WORK SOURCES
set -eu
language=$1 compiler=$2 pkg_config=$3 prefix=$4 work=$5 sources=$6

rm -rf "$work"
mkdir -p "$work"
package=$(find "$prefix" -name periodyn.pc)
export PKG_CONFIG_PATH="${package%/*}"
cd "$work"
flags=$("$pkg_config" --cflags --libs periodyn)
# shellcheck disable=SC2086 # flags are words
if [ "$language" = CXX ]; then
    "$compiler" -std=c++17 -Wall -Wextra -Wpedantic -Werror "$sources/program.cpp" -o program $flags
else
    "$compiler" -std=f2018 -Wall -Werror "$("$pkg_config" --variable=fortran_source periodyn)" \
        "$sources/program.f90" -o program $flags
fi
LD_LIBRARY_PATH=$("$pkg_config" --variable=libdir periodyn) ./program
