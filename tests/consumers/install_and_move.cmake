# Installs BUILD to INSTALLED, then moves all of it to MOVED: what still works needs no fixed place.
cmake_minimum_required(VERSION 3.20)

file(REMOVE_RECURSE "${INSTALLED}" "${MOVED}")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --config "${CONFIG}" --prefix "${INSTALLED}"
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${INSTALLED}" "${MOVED}")

file(GLOB_RECURSE texts "${MOVED}/*.cmake" "${MOVED}/*.pc" "${MOVED}/*.h" "${MOVED}/*.hpp"
    "${MOVED}/*.f90")
foreach(text IN LISTS texts)
    file(READ "${text}" content)
    string(FIND "${content}" "${BUILD}" place)
    if(NOT place EQUAL -1)
        message(FATAL_ERROR "${text} names the directory of the build or of the installation")
    endif()
endforeach()
