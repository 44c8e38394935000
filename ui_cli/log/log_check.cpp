#include "ui_cli/log/log_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/build_id.hpp"
#include "base/counted.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/program.hpp"
#include "ui_cli/subprocess.hpp"

namespace mrroc::ui {
namespace {

/// The first difference in words.
std::string sentence(const link::LogVerdict& v) {
  const link::LogDifference& d = *v.first;
  std::string text = fmt::format("{}: {}, message {}", v.process, d.channel, d.number);
  if (d.stamp > 0) text += fmt::format(", for step {}", d.stamp);
  if (!d.behaviour.empty()) text += fmt::format(", behaviour {}", d.behaviour);
  if (!d.function.empty()) text += fmt::format(", {}", d.function);
  if (!d.field.empty()) text += fmt::format(", field {}", d.field);
  return text + fmt::format("\n    logged {}, recomputed {}", d.logged, d.recomputed);
}

std::string result(const link::LogVerdict& v) {
  if (!v.not_checked.empty()) return "not checked: " + v.not_checked;
  if (v.differences > 0) return fmt::format("{}, {} DIFFER", counted(v.compared, "message"), v.differences);
  if (!v.incomplete.empty()) return fmt::format("{}, then {}", counted(v.compared, "message"), v.incomplete);
  return fmt::format("{}, all the same", counted(v.compared, "message"));
}

}  // namespace

Prover programs_beside() {
  return [](const std::string& program, const std::vector<std::string>& arguments) {
    const Finished f = run_program(program_beside(program), arguments);
    if (f.status == -1) throw FaultError(FaultCode::start_failed, fmt::format("cannot start {}", program));
    if (f.status > 1)
      throw FaultError(FaultCode::bad_log,
                       fmt::format("{} could not read the run: exit status {}", program, f.status),
                       "see its own line above");
    // Libraries may have printed something before.
    const std::size_t end = f.out.find_last_not_of('\n');
    const std::size_t begin = f.out.rfind('\n', end);
    return f.out.substr(begin == std::string::npos ? 0 : begin + 1);
  };
}

link::LogVerdict check_process_of(const RunRecord& run, const LoggedProcess& process, const Prover& prove) {
  std::vector<std::string> arguments{"--check", std::filesystem::absolute(run.folder()).string(), "--clock",
                                     run.clock()};
  arguments.insert(arguments.end(), process.arguments.begin(), process.arguments.end());
  return link::verdict_from_json(prove(process.program, arguments));
}

std::vector<link::LogVerdict> check_run(const RunRecord& run, const Prover& prove) {
  if (run.processes().empty())
    throw FaultError(
        FaultCode::bad_log,
        fmt::format("{} does not tell what ran: it has no processes.json", run.folder().string()),
        "check a run of this version");
  std::vector<link::LogVerdict> verdicts;
  for (const LoggedProcess& p : run.processes()) verdicts.push_back(check_process_of(run, p, prove));
  return verdicts;
}

BuildIds build_ids_beside() {
  return [](const std::string& program) { return build_id(program_beside(program)); };
}

std::vector<std::string> changed_programs(const RunRecord& run, const BuildIds& build_ids) {
  std::vector<std::string> changed;
  for (const LoggedProcess& p : run.processes()) {
    if (p.build_id.empty()) continue;
    const std::string now = build_ids(p.program);
    if (!now.empty() && now != p.build_id) changed.push_back(p.name);
  }
  return changed;
}

std::string changed_programs_line(const std::vector<std::string>& changed) {
  if (changed.empty()) return {};
  return fmt::format(
      "this log is of other programs: {} {} changed since the run; a difference may come from that\n",
      joined(changed, ", "), changed.size() == 1 ? "has" : "have");
}

int report_check(const std::filesystem::path& folder, const std::vector<link::LogVerdict>& verdicts,
                 const std::vector<std::string>& changed, const std::string& damage, bool json,
                 std::ostream& out) {
  std::int64_t compared = 0, differences = 0;
  bool whole = damage.empty();
  const bool checked =
      std::ranges::any_of(verdicts, [](const link::LogVerdict& v) { return v.not_checked.empty(); });
  for (const link::LogVerdict& v : verdicts) {
    compared += v.compared;
    differences += v.differences;
    whole = whole && v.incomplete.empty();
  }
  if (json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const link::LogVerdict& v : verdicts) list.push_back(nlohmann::ordered_json::parse(to_json(v)));
    nlohmann::ordered_json j{{"run", folder.string()},       {"checked", checked},
                             {"compared", compared},         {"differences", nullptr},
                             {"complete", checked && whole}, {"damage", damage},
                             {"changed_programs", changed},  {"processes", list}};
    if (checked) j["differences"] = differences;
    out << j.dump(2) << "\n";
  } else {
    out << folder.string() << "\n";
    for (const link::LogVerdict& v : verdicts) out << fmt::format("  {:<14} {}\n", v.process, result(v));
    for (const link::LogVerdict& v : verdicts)
      if (v.first) out << "  first difference of " << sentence(v) << "\n";
    out << (checked ? fmt::format("  {} recomputed, {} {}\n", counted(compared, "message"), differences,
                                  differences == 1 ? "differs" : "differ")
                    : "  NOT CHECKED: no process of this run can be recomputed\n");
    if (!damage.empty()) out << fmt::format("  the log is not whole: {}\n", damage);
  }
  return differences > 0 || !whole || !checked ? 1 : 0;
}

}  // namespace mrroc::ui
