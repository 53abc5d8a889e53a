# Headers, libraries, CMake package and pkg-config file; the installed tree can be moved as a whole.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(PDN_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/periodyn")
set(PDN_PKGCONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
set(library_permissions PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# periodyn.f90 is a source, which programs compile with their own compiler.
install(FILES
    "${PROJECT_SOURCE_DIR}/include/periodyn.h"
    "${PROJECT_SOURCE_DIR}/include/periodyn.hpp"
    "${PROJECT_SOURCE_DIR}/include/periodyn.f90"
    TYPE INCLUDE)
install(FILES "${PDN_LIBRARY_DIR}/${static_name}" TYPE LIB)

# The file carries the whole version; links carry the soname and the name for the linker.
if(WIN32)
    install(FILES "${PDN_LIBRARY_DIR}/${shared_name}" TYPE BIN)
    install(FILES "${PDN_LIBRARY_DIR}/periodyn.dll.lib" TYPE LIB)
    set(PDN_INSTALLED_SHARED "${CMAKE_INSTALL_BINDIR}/${shared_name}")
else()
    if(APPLE)
        set(full_name "libperiodyn.${PROJECT_VERSION}.dylib")
    else()
        set(full_name "${shared_name}.${PROJECT_VERSION}")
    endif()
    install(FILES "${PDN_LIBRARY_DIR}/${shared_name}" TYPE LIB RENAME ${full_name}
        ${library_permissions})
    set(links "${PROJECT_BINARY_DIR}/links")
    file(MAKE_DIRECTORY "${links}")
    file(CREATE_LINK ${full_name} "${links}/${soname}" SYMBOLIC)
    file(CREATE_LINK ${soname} "${links}/${shared_name}" SYMBOLIC)
    install(FILES "${links}/${soname}" "${links}/${shared_name}" TYPE LIB)
    set(PDN_INSTALLED_SHARED "${CMAKE_INSTALL_LIBDIR}/${full_name}")
endif()
set(PDN_INSTALLED_STATIC "${CMAKE_INSTALL_LIBDIR}/${static_name}")
set(PDN_INSTALLED_SONAME "${soname}")
if(APPLE)
    set(PDN_INSTALLED_SONAME "@rpath/${soname}")
endif()

configure_package_config_file(cmake/periodynConfig.cmake.in
    "${PROJECT_BINARY_DIR}/package/periodynConfig.cmake"
    INSTALL_DESTINATION "${PDN_PACKAGE_DIR}"
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR PDN_INSTALLED_SHARED PDN_INSTALLED_STATIC)
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(compatibility SameMinorVersion)
else()
    set(compatibility SameMajorVersion)
endif()
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/periodynConfigVersion.cmake"
    COMPATIBILITY ${compatibility})
install(FILES
    "${PROJECT_BINARY_DIR}/package/periodynConfig.cmake"
    "${PROJECT_BINARY_DIR}/package/periodynConfigVersion.cmake"
    cmake/PeriodynFortran.cmake
    DESTINATION "${PDN_PACKAGE_DIR}")

# pkg-config finds the prefix from where the file lies.
file(RELATIVE_PATH PDN_PREFIX_FROM_PC
    "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" PDN_PREFIX_FROM_PC "${PDN_PREFIX_FROM_PC}")
list(TRANSFORM PDN_NATIVE_LIBS PREPEND "-l" OUTPUT_VARIABLE native_flags)
string(REPLACE ";" " " PDN_NATIVE_FLAGS "${native_flags}")
configure_file(cmake/periodyn.pc.in "${PROJECT_BINARY_DIR}/package/periodyn.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/package/periodyn.pc" DESTINATION "${PDN_PKGCONFIG_DIR}")
