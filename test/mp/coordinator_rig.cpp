#include "test/mp/coordinator_rig.hpp"

#include <cstdlib>

#include "base/text_file.hpp"

namespace mrroc::mp {
namespace {

std::filesystem::path new_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "coordinator_test.XXXXXX").string();
  return ::mkdtemp(pattern.data());
}

}  // namespace

CoordinatorRig::CoordinatorRig() : folder_(new_folder()) {
  write_text_file(folder_ / "operator.script", "");
  run.emplace("test", process, folder_, arms);
  for (const std::string& arm : arms)
    reports_.push_back(std::make_unique<link::Outbox<agent_report_t>>(bus, process.route(arm + ".report"),
                                                                      process.context().session_id));
}

CoordinatorRig::~CoordinatorRig() {
  run.reset();
  std::filesystem::remove_all(folder_);
}

link::NodeContext CoordinatorRig::context() {
  link::NodeContext m;
  m.session = "coordinated";
  m.name = "mp";
  m.roster = {"mp"};
  return m;
}

void CoordinatorRig::report_all(std::int64_t i, const Report& report) {
  for (const auto& out : reports_) out->publish(to_message(report), i);
}

}  // namespace mrroc::mp
