# Small programs: examples and tests.

set(pdn_warnings "")
if(CMAKE_C_COMPILER_ID MATCHES "GNU|Clang")
    set(pdn_warnings -Wall -Wextra -Wpedantic)
    if(PDN_WERROR)
        list(APPEND pdn_warnings -Werror)
    endif()
endif()

set(pdn_fortran_warnings "")
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
    set(pdn_fortran_warnings -std=f2018 -Wall)
    if(PDN_WERROR)
        list(APPEND pdn_fortran_warnings -Werror)
    endif()
endif()

find_program(PDN_VALGRIND valgrind)
if(PDN_BUILD_TESTS AND NOT PDN_VALGRIND)
    pdn_leave_out("valgrind" "tests under it")
endif()
set(pdn_valgrind ${PDN_VALGRIND} --quiet --leak-check=full --error-exitcode=1
    --suppressions=${PROJECT_SOURCE_DIR}/tests/c/valgrind.supp)

# A program NAME from NAME.c, in strict C99.
function(pdn_add_c_program name)
    add_executable(${name} ${name}.c)
    target_compile_options(${name} PRIVATE ${pdn_warnings})
    set_target_properties(${name} PROPERTIES
        C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
    target_link_libraries(${name} PRIVATE periodyn::periodyn)
    if(UNIX)
        target_link_libraries(${name} PRIVATE m)
    endif()
endfunction()

# The test c.NAME: NAME.c must end with 0. And c.NAME.valgrind: so it must under valgrind, without
# leak or invalid access. Arguments after the name go to the program.
function(pdn_add_c_test name)
    pdn_add_c_program(${name})
    add_test(NAME c.${name} COMMAND ${name} ${ARGN})
    if(PDN_VALGRIND)
        add_test(NAME c.${name}.valgrind
            COMMAND ${pdn_valgrind} $<TARGET_FILE:${name}> ${ARGN})
    endif()
endfunction()
