#include "mp/run_session.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/build_id.hpp"
#include "base/joined.hpp"
#include "base/link/lossy_bus.hpp"
#include "base/link/real_time.hpp"
#include "base/program.hpp"
#include "mp/hosts.hpp"
#include "mp/print_line.hpp"
#include "mp/run_folder.hpp"

namespace mrroc::mp {
namespace {

/// As --clock takes it.
std::string word_of(ClockKind clock) { return clock == ClockKind::wall ? "wall" : "step"; }

/// A macrostep at a slow pace is not a silent peer.
std::chrono::milliseconds timeout_at(double speed) {
  if (link::kReceiveTimeout.count() == 0 || speed <= 0) return link::kReceiveTimeout;
  constexpr double kSlowest = 0.2;  // simulated duration of the longest wait [s]
  return link::kReceiveTimeout + std::chrono::milliseconds(std::llround(1e3 * kSlowest / speed));
}

/// @return how long a macrostep lasts [wall time]; 0: as short as it can be
std::chrono::microseconds macrostep_at(const TaskOptions& options, const Config& config) {
  constexpr double kStep = 0.002;  // [s]
  const double speed = options.clock == ClockKind::wall ? 1 : options.speed;
  if (speed <= 0) return {};
  return std::chrono::microseconds(std::llround(1e6 * config.integer<int>("time.n_s", 10) * kStep / speed));
}

}  // namespace

RunSession::RunSession(const std::string& task, const TaskOptions& options,
                       const std::filesystem::path& folder, const Config& config,
                       std::vector<NodeSpec>& nodes)
    : task_(task), folder_(folder), separate_(options.separate) {
  context_.session = options.session.empty() ? link::unique_session_name(task) : options.session;
  const std::vector<Host> hosts = read_hosts(config, options.hosts);
  choose_address(options, assign_hosts(hosts, nodes));
  for (const Host& host : hosts)
    if (!host.processes.empty()) print_line(announcement(host));
  context_.session_id = link::random_id();
  context_.name = "mp";
  context_.roster = {"mp"};
  for (const NodeSpec& p : nodes) context_.roster.push_back(p.name);
  context_.clock = options.clock;
  context_.timeout = timeout_at(options.speed);
  context_.macrostep = macrostep_at(options, config);
  if (const std::string note = link::session_place().note; !note.empty()) print_line(note);
  file_ =
      std::make_unique<link::SessionFile>(link::SessionInfo{.name = name(),
                                                            .id = context_.session_id,
                                                            .address = address_,
                                                            .task = task,
                                                            .run_folder = std::filesystem::absolute(folder)});
  open_bus();
  if (const double loss = link::read_loss(config); loss > 0) {
    lossless_ = std::move(bus_);
    bus_ = std::make_unique<link::LossyBus>(*lossless_, link::loses(loss, options.seed));
  }
}

void RunSession::choose_address(const TaskOptions& options, bool several_hosts) {
  link::LcmAddress address =
      options.url.empty() ? link::address_for(name()) : link::LcmAddress::parse(options.url);
  if (several_hosts) {
    if (!separate_)
      throw FaultError(FaultCode::bad_usage,
                       "some processes are to run on other hosts, which --processes one does not allow");
    if (options.url.empty()) address.ttl = 1;
    if (address.ttl == 0)
      throw FaultError(FaultCode::bad_usage,
                       "nothing leaves this host with " + options.url + ", and some processes run on others",
                       "give --url with ttl=1, or none");
  }
  if (separate_ && !link::multicast_works(address)) {
    if (options.separate_asked)
      throw FaultError(FaultCode::no_multicast,
                       fmt::format("separate processes need multicast, and {} reaches nobody", address.host));
    print_line("no multicast on this host: all in one process; ui_cli cannot attach");
    separate_ = false;
  }
  if (separate_) address_ = address;
}

void RunSession::open_bus() {
  if (address_) {
    bus_ = link::open_session(file_->info());
    return;
  }
  hub_ = std::make_unique<link::MemoryHub>();
  bus_ = hub_->open();
}

void RunSession::write_processes(const std::vector<NodeSpec>& nodes) const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const std::string self = this_program().filename().string();
  list.push_back({{"name", "mp"},
                  {"program", self},
                  {"arguments", nlohmann::ordered_json::array()},
                  {"build_id", build_id(this_program())}});
  for (const NodeSpec& p : nodes) {
    list.push_back({{"name", p.name}, {"program", p.program}, {"arguments", p.arguments}});
    // In one process all of them are this program; what another host has is not known here.
    if (separate_ && p.start.empty()) list.back()["build_id"] = build_id(program_folder() / p.program);
  }
  const nlohmann::ordered_json all{{"task", task_}, {"clock", word_of(context_.clock)}, {"processes", list}};
  write_text(folder_ / "processes.json", all.dump(2) + "\n");
}

void RunSession::start(Supervisor& supervisor) {
  if (hub_) return supervisor.start_threads(*hub_);
  const link::NodeContext& m = context_;
  const bool paced = m.macrostep.count() > 0;
  if (paced) link::keep_in_memory();
  std::vector<std::string> words{
      "--session",
      m.session,
      "--session-id",
      std::to_string(m.session_id),
      "--url",
      address_->url(),
      "--roster",
      joined(m.roster, ","),
      "--clock",
      word_of(m.clock),
      "--timeout",
      std::to_string(std::chrono::duration<double>(m.timeout).count()),
      "--key-fd",
      "0",
      "--config",
      std::filesystem::absolute(folder_ / "config.toml").string()};  // another host begins elsewhere
  if (paced) words.emplace_back("--paced");
  supervisor.start_processes(words, file_->info().key->hex() + "\n");
}

}  // namespace mrroc::mp
