// Cost of the keyed hash that protects each message.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/fault.hpp"
#include "base/link/authentication.hpp"
#include "base/link/decode.hpp"
#include "base/link/key.hpp"
#include "base/link/lcm_packet.hpp"
#include "bench/figures.hpp"
#include "mrroc/hardware_state_t.hpp"

namespace mrroc::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBatches = 2000;
constexpr int kInABatch = 100;  // so that reading the clock costs nothing beside it

}  // namespace

Figure sign_figure() {
  const link::TagKey key(link::Key::random());
  const std::vector<std::uint8_t> message(static_cast<std::size_t>(link::encoded_size<hardware_state_t>()),
                                          1);
  std::vector<std::uint8_t> plain;
  link::write_packet(plain, 1, "session.arm1.hardware_state", message);
  std::vector<std::uint8_t> datagram;
  datagram.reserve(plain.size() + link::kTrailer);
  link::Origin origin{.sender = 1};
  std::vector<double> times;
  for (int batch = 0; batch < kBatches; ++batch) {
    const auto begin = Clock::now();
    for (int k = 0; k < kInABatch; ++k) {
      datagram.assign(plain.begin(), plain.end());
      ++origin.counter;
      link::sign(datagram, origin, key);
      if (link::authenticate(datagram, key) != origin)
        throw FaultError(FaultCode::internal_error, "a signed message is taken for a forged one");
    }
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count() / kInABatch);
  }
  const auto middle = times.begin() + kBatches / 2;
  std::ranges::nth_element(times, middle);
  return {"sign_us_p50", *middle, "us",
          "one state of a drive: signed by its sender and checked by its receiver"};
}

}  // namespace mrroc::bench
