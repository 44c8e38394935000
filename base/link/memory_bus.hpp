// Transport within one process, between threads; for tests and for hosts without multicast.
#pragma once
#include <memory>

#include "base/link/bus.hpp"

namespace mrroc::link {

/// Data that the ends of one system share.
class MemoryHub {
 public:
  MemoryHub();
  ~MemoryHub();
  MemoryHub(const MemoryHub&) = delete;
  MemoryHub& operator=(const MemoryHub&) = delete;
  /// @return a new end; must not outlive the hub
  std::unique_ptr<Bus> open();

  struct Shared;

 private:
  std::unique_ptr<Shared> shared_;
};

}  // namespace mrroc::link
