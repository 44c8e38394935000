// A host whose memory is used up.
#pragma once

namespace mrroc::link::test {

/// While it lives, this thread gets no memory from `new`.
class NoMemory {
 public:
  NoMemory() noexcept;
  ~NoMemory();
  NoMemory(const NoMemory&) = delete;
  NoMemory& operator=(const NoMemory&) = delete;
};

}  // namespace mrroc::link::test
