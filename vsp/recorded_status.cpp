#include "vsp/recorded_status.hpp"

#include <exception>

#include "base/fault.hpp"
#include "base/print.hpp"

namespace mrroc::vsp {
namespace {

int told(const FaultError& e) {
  print(stderr, e.error_line() + "\n");
  return exit_status(e.fault().code);
}

}  // namespace

int recorded_status(const std::function<int()>& work) {
  try {
    return work();
  } catch (const FaultError& e) {
    return told(e);
  } catch (const std::exception& e) {
    return told(FaultError(FaultCode::bad_picture, e.what()));
  }
}

}  // namespace mrroc::vsp
