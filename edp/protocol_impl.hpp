// Bodies of edp/protocol.hpp, for the files that instantiate them.
#pragma once
#include "edp/protocol.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "edp/guard.hpp"

namespace mrroc::edp {
namespace detail {

/// @return the text with a number behind it; does not allocate
inline FixedText<160> text_with_number(std::string_view text, std::int64_t number) {
  FixedText<160> result(text);
  char* const end = result.data.data() + result.data.size();
  std::to_chars(result.data.data() + std::min(text.size(), result.data.size()), end, number);
  return result;
}

/// @return a decision to refuse, with the number in its words
template <class Decision>
Decision refuse(FaultCode code, std::string_view text, std::int64_t number, double value = 0,
                double limit = 0) {
  Fault fault = make_fault(code, "", -1, value, limit);
  fault.text = text_with_number(text, number);
  return {Admission::refuse, fault};
}

}  // namespace detail

template <Effector E>
typename BasicProtocol<E>::Decision BasicProtocol<E>::admit(const Command& command, bool guarded) noexcept {
  const bool owned_by_another = owner_ && *owner_ != command.session;
  switch (command.instruction) {
    case Instruction::keep:
      return {};
    case Instruction::release:
      if (owner_ && !owned_by_another) drop_owner();
      return {};
    case Instruction::set:
    case Instruction::get:
    case Instruction::set_get:
    case Instruction::synchro:
    case Instruction::query:
    case Instruction::reset:
      break;
  }
  if (guarded) return {Admission::refuse, make_fault(FaultCode::start_guard, "")};
  if (command.instruction == Instruction::reset) {
    drop_owner();
    return {Admission::reset, {}};
  }
  if (command.instruction == Instruction::query && stored_.number != 0 &&
      stored_.session == command.session && stored_.number == command.queried)
    return {Admission::replay, {}};
  if (owned_by_another) return detail::refuse<Decision>(FaultCode::not_owner, "owner: session ", *owner_);
  if (command.instruction == Instruction::query)
    return detail::refuse<Decision>(FaultCode::unknown_number, "last number: ", owner_ ? expected_ - 1 : 0);
  if (command.number == expected_) return {Admission::execute, {}};
  if (owner_ && command.number == expected_ - 1) {
    ++repeated_;
    return {Admission::replay, {}};
  }
  ++lost_;
  return detail::refuse<Decision>(FaultCode::lost_command, "expected number: ", expected_,
                                  static_cast<double>(command.number), static_cast<double>(expected_));
}

template <Effector E>
void BasicProtocol<E>::conclude(const Command& command, bool executed) noexcept {
  if (!owner_ && !executed) return;
  owner_ = command.session;
  ++expected_;
}

template <Effector E>
void BasicProtocol<E>::drop_owner() noexcept {
  owner_.reset();
  expected_ = 1;
}

}  // namespace mrroc::edp
