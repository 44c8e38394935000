// Whether this build is too slow for deadlines.
#pragma once

namespace mrroc::mp {

/// Under sanitizers nobody is ended for being slow.
#ifdef MRROC_SANITIZED
inline constexpr bool kNoDeadlines = true;
#else
inline constexpr bool kNoDeadlines = false;
#endif

}  // namespace mrroc::mp
