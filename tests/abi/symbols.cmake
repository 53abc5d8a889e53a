# The functions that LIBRARY exports are those of LIST. The list only grows: a name that is gone is a
# break of the ABI, to be taken out by hand together with a new soname.
cmake_minimum_required(VERSION 3.20)

execute_process(COMMAND ${NM} -D --defined-only ${LIBRARY}
    OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n]+\n" exported "${output}")
list(TRANSFORM exported STRIP)
list(SORT exported)
file(STRINGS ${LIST} listed)

set(added ${exported})
list(REMOVE_ITEM added ${listed})
set(gone ${listed})
list(REMOVE_ITEM gone ${exported})

if(gone)
    message(FATAL_ERROR "no longer exported, which breaks programs: ${gone}")
endif()
if(added AND DEFINED ENV{PDN_BLESS})
    list(JOIN added "\n" lines)
    file(APPEND ${LIST} "${lines}\n")
elseif(added)
    message(FATAL_ERROR "not in ${LIST}: ${added}\nPDN_BLESS=1 ctest -R abi.symbols appends them")
endif()
