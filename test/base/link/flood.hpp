// A process that fills a multicast address with datagrams, as fast as it is told.
#pragma once
#include <sys/mman.h>
#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <new>
#include <vector>

#include "test/base/link/stranger.hpp"

namespace mrroc::link::test {

/// Lives as long as the object.
class Flood {
 public:
  /// @param datagrams  are sent in turn, at least one  @param rate  of them [1/s]
  Flood(const LcmAddress& to, const std::vector<Bytes>& datagrams, double rate)
      : sent_(new (::mmap(nullptr, sizeof(Sent), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
                  Sent{}),
        child_(::fork()) {
    if (child_ == 0) send(Stranger(to), datagrams, rate);
  }
  ~Flood() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    ::munmap(sent_, sizeof(Sent));
  }
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;

  /// @return datagrams so far
  [[nodiscard]] long sent() const { return *sent_; }

 private:
  using Sent = std::atomic<long>;

  [[noreturn]] void send(const Stranger& stranger, const std::vector<Bytes>& datagrams, double rate) const {
    const auto begun = std::chrono::steady_clock::now();
    for (long n = 0;; ++n) {
      stranger.send(datagrams[static_cast<std::size_t>(n) % datagrams.size()]);
      *sent_ = n;
      while (static_cast<double>(n) >
             rate * std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count())
        ::usleep(100);
    }
  }

  Sent* sent_;  // shared with the child
  pid_t child_;
};

}  // namespace mrroc::link::test
