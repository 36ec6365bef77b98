// The compiled part of Asio (ASIO_SEPARATE_COMPILATION in host/CMakeLists.txt).
#include <asio/impl/src.hpp>
