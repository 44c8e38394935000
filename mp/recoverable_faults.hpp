// The faults after which a task goes on.
#pragma once
#include <cstdint>
#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "mp/run_folder.hpp"
#include "mp/run_log.hpp"

namespace mrroc::mp {

/// Reports each fault as a message, in the summary, and in a black box.
class RecoverableFaults {
 public:
  static constexpr std::size_t kMostBoxes = 5;  ///< of one run

  /// Both must outlive this object. @param log  null: no black box is written
  RecoverableFaults(link::Process& process, const std::filesystem::path& folder, RunLog* log)
      : process_(process), folder_(folder), log_(log) {}

  /// As TaskRun::report_recoverable_fault(). @param i  present macrostep  @param sim_s  simulated time [s]
  void report(const Fault& fault, const std::string& advice, std::int64_t i, double sim_s);
  /// Waits until all black boxes are written. @return the faults in the order in which they came
  [[nodiscard]] const std::vector<RecoverableFault>& finish();

 private:
  link::Process& process_;
  std::filesystem::path folder_;
  RunLog* log_;
  std::vector<RecoverableFault> faults_;
  std::vector<std::future<void>> boxes_;  // that are being written
};

}  // namespace mrroc::mp
