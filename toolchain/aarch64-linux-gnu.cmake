# Cross build for 64-bit ARM boards: Debian's cross compiler and the sysroot that toolchain/arm64_sysroot makes. What is built
# runs here too, through qemu (toolchain/run_arm64). toolchain/test_arm64 does it all.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(TOUCHSTONE_DEBIAN_ARCHITECTURE arm64)

set(TOUCHSTONE_SYSROOT ${CMAKE_CURRENT_LIST_DIR}/../build/sysroot-arm64 CACHE PATH "Debian arm64 root to build against")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TOUCHSTONE_SYSROOT)
get_filename_component(CMAKE_SYSROOT ${TOUCHSTONE_SYSROOT} ABSOLUTE)
if(NOT EXISTS ${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu)
    message(FATAL_ERROR "${CMAKE_SYSROOT} is no arm64 sysroot: run toolchain/arm64_sysroot first, "
        "or name one with -DTOUCHSTONE_SYSROOT=FOLDER")
endif()

set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/run_arm64 --root ${CMAKE_SYSROOT})

# Libraries and headers of the sysroot only, programs of this machine only.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)
