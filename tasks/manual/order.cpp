#include "tasks/manual/order.hpp"

#include <algorithm>
#include <cmath>

#include "base/msg/finite.hpp"

namespace mrroc::manual {

manual_order_t to_message(const ManualOrder& o) {
  manual_order_t m{};
  m.number = o.number;
  m.kind = static_cast<std::int8_t>(o.kind);
  m.space = static_cast<std::int8_t>(o.space);
  m.reference = static_cast<std::int8_t>(o.reference);
  std::ranges::copy(o.value, m.value);
  m.velocity = o.velocity;
  m.acceleration = o.acceleration;
  m.model = static_cast<std::int16_t>(o.model);
  m.algorithm = static_cast<std::int8_t>(o.algorithm);
  m.parameter_set = static_cast<std::int8_t>(o.parameter_set);
  return m;
}

}  // namespace mrroc::manual

namespace mrroc {

manual::ManualOrder from_message(const manual_order_t& m) {
  manual::ManualOrder o;
  o.number = m.number;
  o.kind = static_cast<manual::Kind>(m.kind);
  o.space = static_cast<Representation>(m.space);
  o.reference = static_cast<Reference>(m.reference);
  std::ranges::copy(m.value, o.value.begin());
  o.velocity = m.velocity;
  o.acceleration = m.acceleration;
  o.model = static_cast<std::uint16_t>(m.model);
  o.algorithm = static_cast<std::uint8_t>(m.algorithm);
  o.parameter_set = static_cast<std::uint8_t>(m.parameter_set);
  return o;
}

bool is_proper(const manual_order_t& m) noexcept {
  return m.kind >= 0 && m.kind <= static_cast<int>(manual::Kind::stop) && finite(m.value) &&
         std::isfinite(m.velocity) && std::isfinite(m.acceleration);
}

}  // namespace mrroc
