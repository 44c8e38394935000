// That a message comes back whole from the value that it was converted to, field by field.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "base/msg/message_type.hpp"
#include "test/base/msg/wire.hpp"

namespace mrroc::test {

template <class M>
const MessageType& type_of_message() {
  return *type_of(bytes_of(M{}));
}

/// @return whether the field is a yes or no, which any number but 0 says
inline bool is_flag(const Field& f) {
  constexpr std::array<std::string_view, 6> kFlags{"ready",    "seen",     "ambiguous",
                                                   "finished", "go_on[0]", "go_on[1]"};
  constexpr std::array<std::string_view, 14> kNumbers{"instruction",
                                                      "verdict",
                                                      "state",
                                                      "set",
                                                      "get",
                                                      "get_representation",
                                                      "get_tool_representation",
                                                      "tool_representation",
                                                      "driver_state",
                                                      "mu",
                                                      "representation",
                                                      "reference",
                                                      "feedback",
                                                      "b"};
  std::string_view name(f.name);
  const auto is_in = [&](const auto& names) { return std::ranges::find(names, name) != names.end(); };
  if (f.kind == FieldKind::int32) return is_in(kFlags) || name == "valid";
  name = name.substr(name.rfind('.') + 1);
  return f.kind == FieldKind::int8 && !is_in(kNumbers);
}

/// Every field of the message but the header, and what its channel or support_of() tells, comes back from the value that it was converted to.
template <class M>
void expect_all_back(const M& m) {
  const auto sent = bytes_of(m), back = bytes_of(to_message(from_message(m)));
  for (const Field& f : type_of_message<M>().fields) {
    if (f.name.starts_with("header.") || f.name.starts_with("support.") || f.name == "begun" ||
        f.name == "last")
      continue;
    if (is_flag(f))
      ASSERT_EQ(number_in(sent, f) != 0, number_in(back, f) != 0) << f.name;
    else
      ASSERT_TRUE(std::ranges::equal(std::span(sent).subspan(f.offset, f.size),
                                     std::span(back).subspan(f.offset, f.size)))
          << f.name;
  }
}

}  // namespace mrroc::test
