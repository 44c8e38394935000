#include "tasks/manual/order.hpp"

#include <algorithm>

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

ManualOrder from_message(const manual_order_t& m) {
  ManualOrder o;
  o.number = m.number;
  const bool known = m.kind >= 0 && m.kind <= static_cast<int>(Kind::stop);
  o.kind = known ? static_cast<Kind>(m.kind) : Kind::nothing;
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

}  // namespace mrroc::manual
