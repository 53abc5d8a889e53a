# The programs in docs/cpp_and_fortran.md, as they stand there.
set(page "${PROJECT_SOURCE_DIR}/docs/cpp_and_fortran.md")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
file(READ "${page}" text)

function(add_docs_program language suffix)
    string(FIND "${text}" "```${language}\n" start)
    string(LENGTH "```${language}\n" length)
    math(EXPR start "${start} + ${length}")
    string(SUBSTRING "${text}" ${start} -1 program)
    string(FIND "${program}" "```" length)
    string(SUBSTRING "${program}" 0 ${length} program)
    file(CONFIGURE OUTPUT "docs_${language}.${suffix}" CONTENT "${program}" @ONLY)
    add_executable(docs_${language} "${CMAKE_CURRENT_BINARY_DIR}/docs_${language}.${suffix}")
    target_link_libraries(docs_${language} PRIVATE ${ARGN})
    add_test(NAME docs.${language} COMMAND docs_${language})
    set_tests_properties(docs.${language} PROPERTIES PASS_REGULAR_EXPRESSION "converged.*angle 0?\\.387993")
endfunction()

add_docs_program(cpp cpp periodyn::periodyn)
target_compile_features(docs_cpp PRIVATE cxx_std_17)
target_compile_options(docs_cpp PRIVATE ${pdn_warnings})
if(TARGET periodyn::fortran)
    add_docs_program(fortran f90 periodyn::fortran)
    target_compile_options(docs_fortran PRIVATE ${pdn_fortran_warnings})
endif()

# What docs/families.md says that the example prints.
if(PDN_BUILD_EXAMPLES AND PDN_PYTHON)
    set(page "${PROJECT_SOURCE_DIR}/docs/families.md")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
    file(READ "${page}" text)
    string(REGEX MATCH "```text\n([^`]*)```" printed "${text}")
    file(CONFIGURE OUTPUT sensitivities.txt CONTENT "${CMAKE_MATCH_1}" @ONLY)
    add_test(NAME docs.sensitivities
        COMMAND ${PDN_PYTHON} "${CMAKE_CURRENT_SOURCE_DIR}/same_text.py"
            "${CMAKE_CURRENT_BINARY_DIR}/sensitivities.txt" $<TARGET_FILE:sensitivities>)
endif()
