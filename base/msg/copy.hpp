// Copies numbers between the arrays of a value and those of its message.
#pragma once
#include <algorithm>
#include <iterator>

namespace mrroc {

/// @param to  has at least as many elements as `from`. Real-time safe
template <class From, class To>
void copy(const From& from, To& to) {
  std::copy(std::begin(from), std::end(from), std::begin(to));
}

}  // namespace mrroc
