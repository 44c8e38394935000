#include "bench/run_summary.hpp"

#include <fstream>

#include "base/fault.hpp"

namespace mrroc::bench {

nlohmann::json run_summary(const std::filesystem::path& folder) {
  std::ifstream file(folder / "summary.json");
  nlohmann::json summary = nlohmann::json::parse(file, nullptr, false);
  return summary.is_discarded() ? nlohmann::json{} : summary;
}

nlohmann::json needed_summary(const std::filesystem::path& folder) {
  nlohmann::json summary = run_summary(folder);
  if (summary.is_null()) throw FaultError(FaultCode::internal_error, "a run has left no summary.json");
  return summary;
}

}  // namespace mrroc::bench
