# System libraries that the static library needs, by platform. A fixed list: what rustc says at build
# time comes too late for CMake. The test abi.native_libs holds the two together.
if(APPLE)
    set(PDN_NATIVE_LIBS System c m)
elseif(WIN32)
    set(PDN_NATIVE_LIBS kernel32 ntdll userenv ws2_32 dbghelp)
else()
    set(PDN_NATIVE_LIBS gcc_s util rt pthread m dl c)
endif()
