#include "bench/run_summary.hpp"

#include <fstream>

namespace mrroc::bench {

nlohmann::json run_summary(const std::filesystem::path& folder) {
  std::ifstream file(folder / "summary.json");
  nlohmann::json summary = nlohmann::json::parse(file, nullptr, false);
  return summary.is_discarded() ? nlohmann::json{} : summary;
}

}  // namespace mrroc::bench
