#include "tasks/drawing/run_setup.hpp"

#include "base/fault.hpp"
#include "tasks/drawing/config.hpp"

namespace mrroc::drawing {

RunSetup read_setup(const InputOptions& o, const Config& config, const std::filesystem::path& checked,
                    bool gives_orders) try {
  RunSetup s;
  s.input = read_input(checked.empty() ? o : input_of_run(checked));
  s.k = read_parameters(config);
  s.plan = read_hand_plan(config, s.input.start());
  s.plan.gives_orders = gives_orders;
  if (s.input.taught) check_macrostep(*s.input.taught, s.k, o.load);
  return s;
} catch (const FileError& e) {
  throw FaultError(o.load.empty() ? FaultCode::bad_drawing : FaultCode::bad_recording, e.wrong(), e.remedy());
}

}  // namespace mrroc::drawing
