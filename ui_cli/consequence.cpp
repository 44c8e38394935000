#include "ui_cli/consequence.hpp"

namespace mrroc::ui {
namespace {

std::string_view consequence(FaultClass fault_class) {
  switch (fault_class) {
    case FaultClass::non_fatal:
      return "a command is refused or a motion stopped; the effector goes on working, and the task goes on "
             "or ends";
    case FaultClass::fatal:
      return "the effector stops and accepts nothing but a reset: the task `manual` takes one, every other "
             "task ends";
    case FaultClass::system:
      break;
  }
  return "the task ends and the drives brake";
}

}  // namespace

std::string_view consequence(FaultCode code) {
  switch (code) {
    case FaultCode::none:
      return "nothing";
    case FaultCode::no_contact:
    case FaultCode::object_not_seen:
    case FaultCode::operator_stop:
    case FaultCode::interrupted:
    case FaultCode::time_limit:
    case FaultCode::script_ended:
    case FaultCode::path_not_found:
      return "the effectors come to rest, and the task ends";
    case FaultCode::synchro_switch_missing:
    case FaultCode::synchro_switch_stuck:
    case FaultCode::encoder_index_missing:
      return "the effector stops and accepts nothing but a reset and then SYNCHRO: the task `manual` takes "
             "both, every other task ends";
    case FaultCode::position_unknown:
    case FaultCode::solver_failed:
    case FaultCode::estimate_lost:
    case FaultCode::wheel_blocked:
    case FaultCode::encoder_fault:
      return "the platform brakes, and the task ends: no task takes a reset of a platform, each begins with "
             "SYNCHRO";
    case FaultCode::position_lost:
      return "the platform waits at rest, and goes on when its position is back; after "
             "task.position_timeout the task ends";
    case FaultCode::emergency_stop:
      return "the drives brake at once, and the task ends";
    case FaultCode::figures_missed:
      return "nothing more: the run is over, and its results are written";
    default:
      break;
  }
  return exit_status(code) == 2 ? "nothing is started" : consequence(class_of(code));
}

}  // namespace mrroc::ui
