#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/camera_config.hpp"
#include "base/link/lossy_bus.hpp"
#include "base/print.hpp"
#include "launch/task.hpp"
#include "launch/task_config.hpp"
#include "mp/check_run.hpp"
#include "mp/parameter_list.hpp"
#include "mp/print_line.hpp"
#include "mp/signal_orders.hpp"

namespace mrroc::launch {
namespace {

namespace fs = std::filesystem;

/// An error of a value that an option has set names the option, not the key that it stands for.
/// @param found  KEY=VALUE of all options
ConfigError naming_option(const ConfigError& e, const Task& task, const std::vector<std::string>& found) {
  const auto option = task.typed.find(e.key());
  const std::string& set = e.place().file;
  const auto is = [&set](const std::string& setting) { return set == "--set " + setting; };
  if (option == task.typed.end() || std::ranges::none_of(found, is)) return e;
  const std::string value = set.substr(set.find('=') + 1);
  const std::string wrong = std::string(e.what()).substr(set.size() + 2);  // behind ": "
  return {{fmt::format("{} {}", option->second, value)}, e.key(), wrong};
}

/// The same of an error of values that make no sense beside one another: its text begins with the key of one of them.
FaultError naming_option(const FaultError& e, const Task& task, const std::vector<std::string>& found) {
  const std::string text = e.what();
  const bool usual = e.remedy() == fault_entry(e.fault().code).remedy;
  for (const auto& [key, option] : task.typed) {
    if (!text.starts_with(key + ": ")) continue;
    for (const std::string& setting : found)
      if (setting.starts_with(key + "="))
        return {e.fault().code,
                fmt::format("{} {}{}", option, setting.substr(key.size() + 1), text.substr(key.size())),
                usual ? "correct that option" : std::string(e.remedy())};
  }
  return e;
}

/// @throws FaultError  for a key that an option and --set give: which of them is meant is not guessed
void refuse_twice(const Task& task, const mp::TaskOptions& options, const std::vector<std::string>& found) {
  const auto sets = [](const std::vector<std::string>& settings, const std::string& key) {
    return std::ranges::any_of(settings, [&](const std::string& s) { return s.starts_with(key + "="); });
  };
  for (const auto& [key, option] : task.typed)
    if (sets(options.settings, key) && sets(found, key))
      throw FaultError(FaultCode::bad_usage, fmt::format("{} and --set {} give the same value", option, key),
                       "leave out one of them");
}

/// @return the configuration, from which all parts of the run have read what they need
Setup read_setup(const Task& task, mp::TaskOptions options, const std::vector<std::string>& found) {
  Setup s;
  s.config = load_task_config(options, task.config, task.name, found);
  options.seed = seed_of(s.config);
  if (task.complete) task.complete(s.config, options);
  check_task_options(options);
  s.options = options;
  s.arms = task.arms;
  if (task.more_arms) std::ranges::move(task.more_arms(s.config), std::back_inserter(s.arms));
  check_cell(s.config, s.arms, task.platforms);
  for (const Receptor& r : task.receptors)
    if (r.read) r.read(s.config);
  if (task.prepare) task.prepare(s);
  return s;
}

std::vector<mp::NodeSpec> nodes_of(const Task& task, const Setup& s) {
  std::vector<mp::NodeSpec> nodes = cell_nodes(s.config, s.arms, task.platforms);
  const std::string ecp = task.ecp_program.empty() ? "ecp_" + task.name : task.ecp_program;
  for (const CellArm& arm : s.arms) {
    nodes.push_back(make_node(s.config, "ecp-" + arm.key, ecp, &arm, task.ecp));
    for (const Receptor& r : task.receptors)
      nodes.push_back(
          make_node(s.config, fmt::format("vsp-{}-{}", r.name, arm.key), "vsp_" + r.name, &arm, r.body));
  }
  for (const CellPlatform& platform : task.platforms) {
    const CellArm effector{platform.key, platform.model};
    nodes.push_back(make_node(s.config, "ecp-" + platform.key, ecp, &effector, task.ecp));
  }
  if (task.nodes) std::ranges::move(task.nodes(s), std::back_inserter(nodes));
  return nodes;
}

std::string first_line(const Task& task, const Setup& s, const std::string& session) {
  std::string words = task.words ? ", " + task.words(s) : "";
  // What is lost is sent again after a while: without a word the run would seem to crawl for no reason.
  if (const double loss = link::read_loss(s.config); loss > 0)
    words +=
        fmt::format(", every process loses {:.2g} % of its messages (link.loss), so it is slow", 100 * loss);
  return fmt::format(
      "{}{}, session {}, seed {}{}", task.name, words, session, s.options.seed,
      s.options.scripted() && !task.unattended.empty() ? task.unattended : mp::who_orders(s.options));
}

/// @return keys of the arms, and then of the platforms
std::vector<std::string> effectors_of(const Task& task, const Setup& s) {
  std::vector<std::string> keys = keys_of(s.arms);
  std::ranges::move(keys_of(task.platforms), std::back_inserter(keys));
  return keys;
}

Setup prepare(const Task& task, mp::TaskOptions options) {
  const std::vector<std::string> found = task.found ? task.found(options) : std::vector<std::string>{};
  refuse_twice(task, options, found);
  try {
    return read_setup(task, std::move(options), found);
  } catch (const ConfigError& e) {
    throw naming_option(e, task, found);
  } catch (const FaultError& e) {
    throw naming_option(e, task, found);
  }
}

int run(const Task& task, const mp::TaskOptions& asked) {
  Setup s = prepare(task, asked);
  const mp::TaskOptions& options = s.options;
  const std::vector<std::string> keys = effectors_of(task, s);
  if (options.parameters) {
    complete_config(s.config, options, ".", "");
    return mp::list_parameters(s.config, options);
  }
  if (!options.check.empty())
    return mp::check_coordinator(task.name, options, keys,
                                 [&](mp::TaskRun& run) { return task.coordinator(run, s); });
  if (const std::string instead = task.instead ? task.instead(s) : ""; !instead.empty()) {
    print(stdout, instead);
    return 0;
  }
  const fs::path folder = mp::name_run_folder(options.run_dir, task.name);
  complete_config(s.config, options, folder,
                  task.strokes.empty() ? "" : fs::absolute(folder / task.strokes).string(),
                  !camera_keys(s.config).empty());
  // A run folder without a summary would be left otherwise.
  std::optional<mp::HeldStops> held(std::in_place);
  mp::make_run_folder(folder);
  if (task.files) task.files(folder);
  mp::write_text(folder / "config.toml", s.config.dump());

  mp::TaskRun run(task.name, options, folder, keys, nodes_of(task, s));
  for (std::size_t k = s.arms.size(); k < keys.size(); ++k)
    run.board().set_effector(k, EffectorKind::platform);
  held.reset();  // the run takes them
  mp::print_line(first_line(task, s, run.session()), options.session);
  const std::unique_ptr<mp::CoordinatorRun> coordinator = task.coordinator(run, s);
  run.start();
  mp::Summary summary = run.execute(*coordinator);
  Results results{
      .setup = s, .arms = s.arms, .folder = folder, .coordinator = *coordinator, .summary = summary};
  run.finish([&] { make_results(results, task.results); });
  return mp::print_ending(summary, ending_of(results), options);
}

}  // namespace

int run_task(const Task& task, int argc, char** argv) {
  mp::TaskOptions options;
  CommandLine line(task.about, task.name);
  if (task.options) task.options(line);
  mp::add_task_options(line, options);
  for (const std::string& option : task.instead_of_config)
    line.named(option).excludes(line.named("--config"));
  if (task.relations) task.relations(line);
  return mp::run_command_line(
      line, argc, argv, [&] { return run(task, options); }, task.examples);
}

}  // namespace mrroc::launch
