// Work that is done several pieces at a time.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace mrroc::bench {

/// @param n          pieces of work
/// @param at_a_time  of them, each in a thread of its own, >= 1
/// @param work       called with 0 to n - 1, each once
/// @param done       called with the number of pieces that are done, after each, never twice at a time
/// @return what work gave, in the order of the pieces
/// @throws           what the first piece that failed threw; pieces that were not begun by then are left out
template <class Result>
std::vector<Result> side_by_side(std::size_t n, std::size_t at_a_time,
                                 const std::function<Result(std::size_t)>& work,
                                 const std::function<void(std::size_t)>& done) {
  std::vector<std::optional<Result>> results(n);
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::size_t ended = 0;
  std::exception_ptr failed;
  const auto take_turns = [&] {
    for (std::size_t k = next++; k < n; k = next++) try {
        results[k] = work(k);
        const std::scoped_lock lock(mutex);
        done(++ended);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failed) failed = std::current_exception();
        next = n;
      }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < std::min(n, at_a_time); ++k) threads.emplace_back(take_turns);
  }
  if (failed) std::rethrow_exception(failed);
  std::vector<Result> all;
  for (std::optional<Result>& r : results) all.push_back(std::move(*r));
  return all;
}

}  // namespace mrroc::bench
