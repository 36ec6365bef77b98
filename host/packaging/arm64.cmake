# Builds for 64-bit ARM on a Debian 12 of another architecture, whose `:arm64` libraries lie beside its own
# (tests/package/arm64 makes such a system). qemu runs the tests.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
# GCC reports what changed in its version 10 as if it were news.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
