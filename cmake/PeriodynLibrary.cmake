# The library: cargo builds it, and these targets stand for it.
#
#   periodyn::shared     the shared library
#   periodyn::static     the static library
#   periodyn::periodyn   the shared one, or the static one if BUILD_SHARED_LIBS is set to OFF
#
# Nothing is downloaded here that cargo does not need: give PDN_CARGO_FLAGS=--offline, or the
# environment variable CARGO_NET_OFFLINE=true, to build from what cargo has already.

set(PDN_CARGO_FLAGS "" CACHE STRING "Further arguments of cargo, such as --offline")
set(PDN_RUST_TARGET "" CACHE STRING "Rust target triple for cross compilation")
set(PDN_CARGO_TARGET_DIR "${PROJECT_BINARY_DIR}/cargo" CACHE PATH "Where cargo builds")
mark_as_advanced(PDN_CARGO_TARGET_DIR)

find_program(PDN_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" REQUIRED)
include(PeriodynNativeLibs)

# Before 1.0 a minor version may break the ABI; build.rs says the same to the linker.
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(PDN_SOVERSION "0.${PROJECT_VERSION_MINOR}")
else()
    set(PDN_SOVERSION "${PROJECT_VERSION_MAJOR}")
endif()

set(static_name "${CMAKE_STATIC_LIBRARY_PREFIX}periodyn${CMAKE_STATIC_LIBRARY_SUFFIX}")
set(shared_name "${CMAKE_SHARED_LIBRARY_PREFIX}periodyn${CMAKE_SHARED_LIBRARY_SUFFIX}")
if(APPLE)
    set(soname "libperiodyn.${PDN_SOVERSION}.dylib")
elseif(UNIX)
    set(soname "${shared_name}.${PDN_SOVERSION}")
else()
    set(soname "")
endif()

set(cargo_out "${PDN_CARGO_TARGET_DIR}")
set(cargo_environment "CARGO_TARGET_DIR=${PDN_CARGO_TARGET_DIR}")
set(cargo_flags ${PDN_CARGO_FLAGS})
separate_arguments(cargo_flags)
if(PDN_RUST_TARGET)
    string(APPEND cargo_out "/${PDN_RUST_TARGET}")
    list(APPEND cargo_flags --target ${PDN_RUST_TARGET})
    string(TOUPPER "${PDN_RUST_TARGET}" triple)
    string(REPLACE "-" "_" triple "${triple}")
    list(APPEND cargo_environment "CARGO_TARGET_${triple}_LINKER=${CMAKE_C_COMPILER}")
endif()

# Cargo calls the directory of its dev profile "debug".
set(PDN_LIBRARY_DIR "${cargo_out}/$<IF:$<CONFIG:Debug>,debug,release>")
# rustc writes here which system libraries the static library needs; a test compares it to our list.
set(PDN_NATIVE_LIBS_FILE "${PDN_CARGO_TARGET_DIR}/native-static-libs.txt")

set(link_soname "")
if(soname)
    # Programs of the build tree look for the library by its soname.
    set(link_soname COMMAND ${CMAKE_COMMAND} -E create_symlink
        ${shared_name} "${PDN_LIBRARY_DIR}/${soname}")
endif()

# Cargo is always asked, as only it knows what changed; unchanged files cause no relinking. The crate
# types are named as cargo optimises at link time (Cargo.toml) only where no rlib is among them.
add_custom_target(periodyn_cargo ALL
    COMMAND ${CMAKE_COMMAND} -E env ${cargo_environment}
        ${PDN_CARGO} rustc --lib --crate-type cdylib,staticlib --locked
        --profile $<IF:$<CONFIG:Debug>,dev,release> ${cargo_flags} -- --print=native-static-libs=${PDN_NATIVE_LIBS_FILE}
    ${link_soname}
    BYPRODUCTS "${PDN_LIBRARY_DIR}/${shared_name}" "${PDN_LIBRARY_DIR}/${static_name}"
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    COMMENT "cargo: libperiodyn"
    USES_TERMINAL VERBATIM)

add_library(periodyn::shared SHARED IMPORTED GLOBAL)
add_library(periodyn::static STATIC IMPORTED GLOBAL)
foreach(kind IN ITEMS shared static)
    add_dependencies(periodyn::${kind} periodyn_cargo)
    set_target_properties(periodyn::${kind} PROPERTIES
        IMPORTED_LOCATION "${cargo_out}/release/${${kind}_name}"
        IMPORTED_LOCATION_DEBUG "${cargo_out}/debug/${${kind}_name}"
        INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")
endforeach()
if(WIN32)
    # rustc's name of the import library; "periodyn.lib" is the static one.
    set_target_properties(periodyn::shared PROPERTIES
        IMPORTED_IMPLIB "${cargo_out}/release/periodyn.dll.lib"
        IMPORTED_IMPLIB_DEBUG "${cargo_out}/debug/periodyn.dll.lib")
elseif(APPLE)
    set_target_properties(periodyn::shared PROPERTIES IMPORTED_SONAME "@rpath/${soname}")
else()
    set_target_properties(periodyn::shared PROPERTIES IMPORTED_SONAME "${soname}")
endif()
set_target_properties(periodyn::static PROPERTIES
    INTERFACE_COMPILE_DEFINITIONS PDN_STATIC
    INTERFACE_LINK_LIBRARIES "${PDN_NATIVE_LIBS}")

if(DEFINED BUILD_SHARED_LIBS AND NOT BUILD_SHARED_LIBS)
    add_library(periodyn::periodyn ALIAS periodyn::static)
else()
    add_library(periodyn::periodyn ALIAS periodyn::shared)
endif()
