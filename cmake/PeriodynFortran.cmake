# periodyn::fortran: the modules of periodyn.f90, compiled with the project's own Fortran compiler, as
# module files of one compiler are not those of another. Only if the project has enabled Fortran before.
#
# PDN_FORTRAN_SOURCE  where periodyn.f90 is

get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if("Fortran" IN_LIST languages AND NOT TARGET periodyn_fortran)
    set(modules "${CMAKE_CURRENT_BINARY_DIR}/periodyn_fortran_modules")
    add_library(periodyn_fortran STATIC EXCLUDE_FROM_ALL "${PDN_FORTRAN_SOURCE}")
    set_target_properties(periodyn_fortran PROPERTIES
        Fortran_MODULE_DIRECTORY "${modules}"
        POSITION_INDEPENDENT_CODE ON)
    target_include_directories(periodyn_fortran INTERFACE "${modules}")
    target_link_libraries(periodyn_fortran PUBLIC periodyn::periodyn)
    add_library(periodyn::fortran ALIAS periodyn_fortran)
endif()
