#include "mp/hosts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include "base/joined.hpp"

namespace mrroc::mp {

std::vector<Host> read_hosts(const Config& config) {
  std::vector<Host> hosts;
  for (const std::string& name : config.tables("hosts")) {
    const Config t = config.section("hosts." + name);
    const std::vector<std::string> none;
    hosts.push_back({name, t.texts("processes", none), t.texts("start", none)});
    if (hosts.back().start.empty())
      throw ConfigError({"hosts", 0, 0}, "hosts." + name + ".start",
                        "the words that make a program run there are missing, such as [\"ssh\", \"HOST\"]");
  }
  return hosts;
}

bool assign_hosts(const std::vector<Host>& hosts, std::vector<Part>& parts) {
  bool elsewhere = false;
  for (const Host& host : hosts)
    for (const std::string& process : host.processes) {
      const auto part = std::ranges::find(parts, process, &Part::name);
      const auto refuse = [&](const std::string& text) {
        throw FaultError(FaultCode::bad_configuration,
                         fmt::format("hosts.{}.processes: {}", host.name, text));
      };
      if (part == parts.end()) {
        std::vector<std::string> names;
        for (const Part& p : parts) names.push_back(p.name);
        refuse(fmt::format("the task has no process {}; it has {}", process, joined(names, ", ")));
      }
      if (!part->start.empty()) refuse(process + " has another host already");
      part->start = host.start;
      elsewhere = true;
    }
  return elsewhere;
}

}  // namespace mrroc::mp
