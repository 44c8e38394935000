#include "mp/recoverable_faults.hpp"

#include <fmt/core.h>

#include "base/with_remedy.hpp"
#include "mp/black_box.hpp"

namespace mrroc::mp {

void RecoverableFaults::report(const Fault& fault, const std::string& advice, std::int64_t i, double sim_s) {
  const std::string process(fault.process.view());
  process_.log(with_remedy(what_happened(fault), advice), fault.code);
  faults_.push_back({fault, sim_s});
  if (!log_ || faults_.size() > kMostBoxes) return;
  // Nobody waits for a box in a macrostep: each is written beside those before it.
  boxes_.push_back(std::async(
      std::launch::async,
      [folder = folder_, roster = process_.context().roster, within = fmt::format("{}-{}", process, i),
       as_of = log_->flush()] { write_black_box(folder, roster, within, as_of); }));
}

const std::vector<RecoverableFault>& RecoverableFaults::finish() {
  for (std::future<void>& box : boxes_) box.get();
  boxes_.clear();
  return faults_;
}

}  // namespace mrroc::mp
