// Slow work of the daemon, on the thread of a pool.
#pragma once

#include <asio/awaitable.hpp>
#include <asio/co_spawn.hpp>
#include <asio/thread_pool.hpp>
#include <asio/use_awaitable.hpp>
#include <type_traits>
#include <utility>

namespace unicursal::host {

template <typename Work>
asio::awaitable<std::invoke_result_t<Work>> at_work(Work work) {
  co_return work();
}

/// Runs `work` in the pool's thread; exceptions come back to the caller. `work` returns a value.
template <typename Work>
auto elsewhere(asio::thread_pool& pool, Work work) {
  return asio::co_spawn(pool.get_executor(), at_work(std::move(work)), asio::use_awaitable);
}

}  // namespace unicursal::host
