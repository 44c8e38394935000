#include "mp/message_log.hpp"

#include <fmt/core.h>

namespace mrroc::mp {

void MessageLog::write(std::string_view process, std::string_view text, FaultCode code) {
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  const std::string_view kind = code == FaultCode::none ? "info" : to_string(class_of(code));
  out_ << fmt::format("{:10.3f}  {:10}  {:9}  {:20}  {}\n", seconds, process, kind,
                      code == FaultCode::none ? "-" : to_string(code), text)
       << std::flush;
  last_ = fmt::format("{}: {}", process, text);
  last_code_ = code;
}

}  // namespace mrroc::mp
