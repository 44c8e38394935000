#include "mp/hosts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>
#include <tuple>

#include "base/joined.hpp"

namespace mrroc::mp {

namespace {

/// @return the words of a text, blanks between them
std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

/// @return words by the name of their host
std::map<std::string, std::vector<std::string>> read_starts(const std::vector<std::string>& given) {
  std::map<std::string, std::vector<std::string>> starts;
  for (const std::string& text : given) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const auto words = words_of(equals == std::string::npos ? "" : text.substr(equals + 1));
    if (name.empty() || words.empty())
      throw FaultError(FaultCode::bad_usage,
                       fmt::format("--host {} is not of the form NAME=WORDS, such as robot=ssh robot", text));
    if (!starts.emplace(name, words).second)
      throw FaultError(FaultCode::bad_usage, fmt::format("--host {} is given twice", name));
  }
  return starts;
}

/// Refuses a key that must not be there. @throws ConfigError  with its file and line
[[noreturn]] void refuse(const Config& config, const std::string& key, const std::string& text) {
  ConfigPlace place{"hosts", 0, 0};
  try {
    std::ignore = config.number(key, std::nullopt);  // whatever is no number is told with its place
  } catch (const ConfigError& e) {
    place = e.place();
  }
  throw ConfigError(place, key, text);
}

}  // namespace

std::vector<Host> read_hosts(const Config& config, const std::vector<std::string>& given) {
  auto starts = read_starts(given);
  std::vector<Host> hosts;
  for (const std::string& name : config.tables("hosts")) {
    const Config t = config.section("hosts." + name);
    const std::vector<std::string> none;
    Host host{name, t.texts("processes", none), {}};
    if (config.has("hosts." + name + ".start"))
      refuse(config, "hosts." + name + ".start",
             fmt::format(
                 "hosts.{0}.start: what is run is not taken from a configuration; leave it out, and give "
                 "--host \"{0}=WORDS\" with the words that make a program run there",
                 name));
    const auto start = starts.extract(name);
    if (!start.empty()) host.start = start.mapped();
    if (host.start.empty() && !host.processes.empty())
      throw FaultError(
          FaultCode::bad_configuration,
          fmt::format("hosts.{} has processes, and it is not said how a program starts there", name),
          fmt::format("give --host \"{}=WORDS\", such as --host \"{}=ssh {}\"", name, name, name));
    hosts.push_back(std::move(host));
  }
  if (!starts.empty())
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("--host {0}: the configuration has no [hosts.{0}]", starts.begin()->first));
  return hosts;
}

bool assign_hosts(const std::vector<Host>& hosts, std::vector<NodeSpec>& nodes) {
  bool elsewhere = false;
  for (const Host& host : hosts)
    for (const std::string& process : host.processes) {
      const auto node = std::ranges::find(nodes, process, &NodeSpec::name);
      const auto refuse = [&](const std::string& text) {
        throw FaultError(FaultCode::bad_configuration,
                         fmt::format("hosts.{}.processes: {}", host.name, text));
      };
      if (node == nodes.end()) {
        std::vector<std::string> names;
        for (const NodeSpec& p : nodes) names.push_back(p.name);
        refuse(fmt::format("the task has no process {}; it has {}", process, joined(names, ", ")));
      }
      if (!node->start.empty()) refuse(process + " has another host already");
      node->start = host.start;
      elsewhere = true;
    }
  return elsewhere;
}

std::string announcement(const Host& host) {
  return fmt::format("host {}: {} will be started with `{} PROGRAM ...`", host.name,
                     joined(host.processes, ", "), joined(host.start, " "));
}

}  // namespace mrroc::mp
