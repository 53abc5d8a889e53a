# The system libraries that rustc says the static library needs are those that we tell users.
cmake_minimum_required(VERSION 3.20)

file(READ ${NEEDED} needed)
string(STRIP "${needed}" needed)
list(TRANSFORM LISTED PREPEND "-l")
list(JOIN LISTED " " listed)
if(NOT needed STREQUAL listed)
    message(FATAL_ERROR "rustc: ${needed}\ncmake/PeriodynNativeLibs.cmake: ${listed}")
endif()
