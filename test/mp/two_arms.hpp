// A coordinator of two arms, for tests of its links.
#pragma once
#include <array>
#include <cstdint>

#include "base/operator.hpp"
#include "base/transmission.hpp"

namespace mrroc::mp {

/// A coordinator of two arms, without memory worth the name.
struct Two {
  struct X {
    int c{};
    int e{};
    int V{};
    struct {
      std::array<Report, 2> agent;
      OperatorImage h;
    } T;
    std::int64_t i{}, i_0{};
  };
  struct Y {
    int c{};
    int e{};
    int V{};
    std::array<Order, 2> T;
  };
};

}  // namespace mrroc::mp
