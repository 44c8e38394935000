// Images of others that change at random, and whether two decisions are the same.
#pragma once
#include <array>
#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

#include "base/msg/convert.hpp"
#include "base/operator.hpp"
#include "base/transmission.hpp"

namespace mrroc::contract {

inline bool happens(double probability, std::mt19937& random) {
  return std::bernoulli_distribution(probability)(random);
}

/// A number that wanders about zero. @param scale  how far, roughly
inline void wander(double& x, double scale, std::mt19937& random) {
  x = 0.98 * x + 0.2 * scale * std::normal_distribution<>()(random);
}

// Changes an image by as much as one macrostep may. Discrete values last for some dozens of macrosteps, or nothing that needs them to last
// would ever happen.
inline void vary(SensorReading& r, std::mt19937& random) {
  r.valid = happens(0.95, random);
  if (happens(0.02, random)) r.state = static_cast<int>(random() % 4);
  for (double& x : r.value) wander(x, 1, random);
}
inline void vary(Report& r, std::mt19937& random) {
  r.ready = happens(0.95, random);
  if (happens(0.02, random)) r.sensor = static_cast<int>(random() % 4);
  if (happens(0.02, random)) r.m = static_cast<int>(random() % 8);
  if (happens(0.02, random)) r.event = static_cast<int>(random() % 8);
  r.driver_state = DriverState::executing;
  r.verdict = Verdict::executed;
  for (double& x : r.T_0E) wander(x, 0.5, random);
  for (double& x : r.F_a.v) wander(x, 5, random);
  wander(r.gripper, 0.05, random);
  if (happens(0.02, random)) r.blocked = !r.blocked;
}
inline void vary(Order& o, std::mt19937& random) {
  if (happens(0.05, random)) {
    const auto draw = random();
    o.m = static_cast<int>(draw % 11);
    o.variant = static_cast<int>(draw / 11 % 4);
  }
  for (bool& go : o.go_on) go = happens(0.05, random);
  o.finished = o.finished || happens(0.001, random);
  o.arm.mu = Interpolation::tcim_velocity;
  for (const Axis a : kAxes) wander(o.arm.frame[a].velocity, 0.05, random);
}
inline void vary(EffectorReply& r, std::mt19937& random) {
  ++r.number;
  r.verdict = Verdict::executed;
  r.state = DriverState::executing;
  for (double& x : r.T_0E) wander(x, 0.5, random);
  for (double& x : r.F_a.v) wander(x, 5, random);
  for (double& x : r.joints) wander(x, 1, random);
  for (double& x : r.motors) wander(x, 100, random);
  wander(r.gripper, 0.05, random);
  if (happens(0.02, random)) r.blocked = !r.blocked;
}
inline void vary(OperatorImage& h, std::mt19937& random) {
  h.started = h.started || happens(0.02, random);
  if (happens(0.01, random)) ++h.trigger;
  if (happens(h.paused ? 0.05 : 0.005, random)) h.paused = !h.paused;
}
template <class T, std::size_t n>
void vary(std::array<T, n>& all, std::mt19937& random) {
  for (T& x : all) vary(x, random);
}
template <class T>
void vary(std::vector<T>& all, std::mt19937& random) {
  for (T& x : all) vary(x, random);
}
/// A part that an agent does not have.
template <class T>
requires std::is_empty_v<T>
void vary(T&, std::mt19937&) {}

/// @return whether two decisions are the same: by operator ==, or as they travel
template <class T>
bool same(const T& a, const T& b) {
  if constexpr (std::is_empty_v<T>) {
    return true;
  } else if constexpr (requires { a == b; }) {
    return a == b;
  } else {
    const auto bytes = [](const T& x) {
      const auto message = to_message(x);
      std::vector<std::uint8_t> encoded(static_cast<std::size_t>(message.getEncodedSize()));
      message.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
      return encoded;
    };
    return bytes(a) == bytes(b);
  }
}
template <class T, std::size_t n>
bool same(const std::array<T, n>& a, const std::array<T, n>& b) {
  for (std::size_t k = 0; k < n; ++k)
    if (!same(a[k], b[k])) return false;
  return true;
}
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!same(a[k], b[k])) return false;
  return true;
}

}  // namespace mrroc::contract
