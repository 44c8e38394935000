#include "ui_cli/commands.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <string>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "ui_cli/attach.hpp"
#include "ui_cli/completion.hpp"
#include "ui_cli/manual_command.hpp"
#include "ui_cli/report.hpp"
#include "ui_cli/watch.hpp"

namespace mrroc::ui {
namespace {

constexpr const char* kAbout =
    "The operator's terminal: shows a running task and gives it orders.\n"
    "Without a command: the full-screen view.";

const ExplainedLines kLines{{"./run drawing --attended", "start a task that waits for its operator"},
                            {"ui_cli", "look at it, in another terminal"},
                            {"ui_cli start", "let it begin"},
                            {"ui_cli pause", "hold it for a moment"},
                            {"ui_cli resume", "go on"},
                            {"ui_cli status --json", "for scripts"},
                            {"ui_cli list", "what runs here"},
                            {"ui_cli stop --session NAME", "when several tasks run"}};

constexpr const char* kExitStatus =
    "\nExit status:\n"
    "  0  done\n"
    "  1  the task refused the order\n"
    "  2  bad usage, or no such session\n"
    "  3  system error: the task is silent, or there is no multicast\n"
    "On 1 to 3 the last line on standard error is  error: CODE: what happened; what to do";

const Examples kExamples{"ui_cli completion bash", "ui_cli status --session press",
                         "ui_cli status --session cell --url udpm://239.255.76.67:7667?ttl=1"};

constexpr const char* kCommandFooter =
    "\nEvery command takes --session NAME, --url URL, --key-file FILE and --json; see `ui_cli --help`.";

struct OrderHelp {
  OperatorOrder order;
  const char* help;
};
constexpr std::array<OrderHelp, 6> kOrders{{
    {OperatorOrder::start, "Let a task begin that waits for its operator"},
    {OperatorOrder::pause,
     "Let arms rest and keep their forces, platforms stand; simulated time goes on, the task does not"},
    {OperatorOrder::resume, "Go on after a pause"},
    {OperatorOrder::trigger, "End a behaviour that waits for the operator"},
    {OperatorOrder::stop, "Stop the task for good; everything comes to rest"},
    {OperatorOrder::emergency_stop, "Emergency stop: the drives brake in the next step, and the task ends"},
}};

/// A connection with the session that the user meant.
struct Connection {
  Connection(const SessionSelector& selector, const Environment& environment)
      : Connection(choose_session(selector, link::running_sessions(environment.sessions)), environment) {}

  std::unique_ptr<link::Bus> bus;
  Client client;

 private:
  Connection(const link::SessionInfo& session, const Environment& environment)
      : bus(environment.open(session)), client(*bus, session, environment.timeouts) {}
};

/// Meaning of the command's words.
struct Request {
  SessionSelector selector;
  bool json{};
  bool yes{};                     ///< also a trigger that comes early
  std::string shell;              ///< whose completion is wanted
  std::function<void()> command;  ///< throws what goes wrong
  int status{};                   ///< of a tool
};

/// A trigger cannot be taken back: one that comes early must be meant.
/// @throws FaultError illegal_in_state with the task's reason
void refuse_early(Client& client, const Request& request, const Environment& environment) {
  const Snapshot s = client.await_status();
  if (!s.waits_for_trigger || s.early.empty()) return;
  if (request.json) environment.out << answer_json({OperatorOrder::trigger, false, s.early});
  throw FaultError(FaultCode::illegal_in_state, "trigger refused: " + s.early,
                   "wait until that is done, or give `ui_cli trigger --yes`");
}

/// @return the options that were given before the tool's name, as words behind it
/// @throws FaultError bad_usage: the tool has no such option
std::vector<std::string> given_before(const Request& request, const Tool& tool,
                                      const std::vector<std::string>& behind) {
  std::vector<std::string> words;
  const auto hand_on = [&](const std::string& option, const std::string& value) {
    if (value.empty()) return;
    if (std::ranges::find(tool.words, option) == tool.words.end())
      throw FaultError(FaultCode::bad_usage, fmt::format("{} takes no {}", tool.name, option));
    const auto again = [&](const std::string& w) { return w == option || w.starts_with(option + "="); };
    if (std::ranges::none_of(behind, again)) words.insert(words.end(), {option, value});
  };
  hand_on("--session", request.selector.session);
  hand_on("--url", request.selector.url);
  hand_on("--key-file", request.selector.key_file.string());
  if (request.json) words.emplace_back("--json");
  return words;
}

void add_tools(CommandLine& line, Request& request, const Environment& environment) {
  for (const Tool& tool : environment.tools) {
    CommandLine& command = line.subcommand(tool.name, tool.about);
    command.take_words_unread();  // the tool reads its own options
    command.when_given([&request, &environment, &tool, &command] {
      request.command = [&, arguments = command.remaining()]() mutable {
        const auto before = given_before(request, tool, arguments);
        arguments.insert(arguments.end(), before.begin(), before.end());
        request.status = tool.run(arguments, environment.out, environment.err);
      };
    });
  }
}

void add_commands(CommandLine& line, Request& request, const Environment& environment) {
  const auto look = [&request, &environment] {
    Connection c(request.selector, environment);
    watch(*c.bus, c.client, request.selector.session);
  };
  request.command = look;
  line.subcommand("watch", "Full-screen view (the default)").when_given([&request, look] {
    request.command = look;
  });
  line.subcommand("status", "Show the task, its processes and its agents once").when_given([&] {
    request.command = [&] {
      const Snapshot s = Connection(request.selector, environment).client.await_status();
      environment.out << (request.json ? status_json(s) : status_text(s, request.selector.session));
    };
  });
  line.subcommand("list", "List the tasks that run on this host").when_given([&] {
    request.command = [&] {
      const auto running = link::running_sessions(environment.sessions);
      environment.out << (request.json ? sessions_json(running) : sessions_text(running));
    };
  });
  for (const OrderHelp& o : kOrders) {
    CommandLine& command = line.order(std::string(to_string(o.order)), o.help);
    if (o.order == OperatorOrder::trigger)
      command.flag("--yes", request.yes, "Also when the task says that it is too early");
    command.when_given([&, order = o.order] {
      request.command = [&, order] {
        Connection connection(request.selector, environment);
        if (order == OperatorOrder::trigger && !request.yes)
          refuse_early(connection.client, request, environment);
        const Answer answer = connection.client.order(order);
        if (request.json) environment.out << answer_json(answer);
        if (!answer.accepted && answer.code != FaultCode::none) throw FaultError(answer.code, answer.text);
        if (!answer.accepted)
          throw FaultError(FaultCode::illegal_in_state,
                           std::string(to_string(order)) + " refused: " + answer.text);
        if (!request.json) environment.out << answer_text(answer);
      };
    });
  }
}

/// Every command with its options, as the shell completes them.
std::vector<CompletedCommand> completed(const CommandLine& line, const Environment& environment) {
  std::vector<CompletedCommand> all;
  for (const CommandLine* command : line.subcommands()) {
    CompletedCommand c{command->name(), command->about(), {}};
    const auto tool = std::ranges::find(environment.tools, c.name, &Tool::name);
    if (tool != environment.tools.end()) {
      c.words = tool->words;
    } else if (c.name == "manual") {
      c.words = manual_words();
    } else if (c.name == "completion") {
      c.words = {"bash", "zsh"};
    } else {
      for (const CommandLine* options : {command, &line})
        for (const std::string& name : options->long_options())
          if (std::ranges::find(c.words, name) == c.words.end()) c.words.push_back(name);
    }
    if (std::ranges::find(c.words, "--help") == c.words.end()) c.words.emplace_back("--help");
    all.push_back(std::move(c));
  }
  return all;
}

void add_completion(CommandLine& line, Request& request, const Environment& environment) {
  CommandLine& command = line.subcommand("completion", "Print the completion script of a shell");
  command.option("shell", request.shell, "bash or zsh").required().one_of({"bash", "zsh"});
  command.when_given([&] {
    request.command = [&] {
      const auto commands = completed(line, environment);
      environment.out << (request.shell == "bash" ? bash_completion(commands) : zsh_completion(commands));
    };
  });
}

/// The words of an instruction hold numbers that may look like options.
void add_manual(CommandLine& line, Request& request, const Environment& environment) {
  CommandLine& command = line.subcommand("manual", "Move the idle arms of the task `manual` by hand");
  command.take_words_unread();
  command.when_given([&request, &environment, &command] {
    request.command = [&request, &environment, arguments = command.remaining()] {
      if (arguments.empty()) {
        environment.out << manual_help();
        return;
      }
      ManualRequest manual = read_manual_words(arguments);
      manual.json = manual.json || request.json;
      if (manual.session.empty()) manual.session = request.selector.session;
      request.selector.session = manual.session;  // hints name it
      if (manual.url.empty()) manual.url = request.selector.url;
      if (manual.key_file.empty()) manual.key_file = request.selector.key_file;
      Connection c({manual.session, manual.url, manual.key_file}, environment);
      if (c.client.session().id == 0) c.client.await_status();
      execute_manual(*c.bus, c.client.session(), manual, environment.timeouts, environment.out);
    };
  });
}

/// @return the exit status when the words ask for help, in whatever place: then it has been printed
std::optional<int> help(const CommandLine& line, const Environment& environment,
                        const std::vector<std::string>& words) {
  const auto asked = line.help_asked(words);
  if (!asked) return std::nullopt;
  const auto commands = line.subcommands();
  const auto command = std::ranges::find_if(words, [&](const std::string& word) {
    return std::ranges::any_of(commands, [&](const CommandLine* c) { return c->name() == word; });
  });
  const std::string name = command == words.end() ? "" : *command;
  if (const auto tool = std::ranges::find(environment.tools, name, &Tool::name);
      tool != environment.tools.end()) {
    std::vector<std::string> behind(std::next(command), words.end());
    if (!asks_for_help(behind)) behind.emplace_back("--help");
    return tool->run(behind, environment.out, environment.err);
  }
  environment.out << (name == "manual" ? manual_help() : *asked);
  return 0;
}

int fail(const Environment& environment, const FaultError& error, const std::string& session) {
  environment.out << std::flush;
  environment.err << error.error_line(session) << std::endl;
  return exit_status(error.fault().code);
}

}  // namespace

int run(int argc, const char* const* argv, const Environment& environment) {
  Request request;
  CommandLine line(kAbout, "ui_cli");
  line.take_one_subcommand(false);
  line.take_options_anywhere();
  line.option("--session", request.selector.session, "Name of the session; not needed when one task runs")
      .type_name("NAME");
  line.option("--url", request.selector.url, "Where a task of another host talks: udpm://HOST:PORT?ttl=N")
      .type_name("URL");
  line.option("--key-file", request.selector.key_file,
              "Key of a session of another host: a copy of its .key file")
      .type_name("FILE");
  line.flag("--json", request.json, "Print JSON");
  line.footer(kCommandFooter);  // inherited by the commands
  add_commands(line, request, environment);
  add_tools(line, request, environment);
  add_manual(line, request, environment);
  add_completion(line, request, environment);
  line.footer("\nExamples:\n" + explained(kLines) + kExitStatus);
  if (const auto status = help(line, environment, {argv + 1, argv + argc})) return *status;
  try {
    line.parse(argc, argv, kExamples);
  } catch (const FaultError& e) {
    return fail(environment, e, "");
  }
  try {
    request.command();
    return request.status;
  } catch (const FaultError& e) {
    return fail(environment, e, request.selector.session);
  } catch (const link::NoMulticast& e) {
    return fail(environment, FaultError(FaultCode::no_multicast, e.what()), request.selector.session);
  } catch (const std::exception& e) {
    return fail(environment, FaultError(FaultCode::internal_error, e.what()), request.selector.session);
  }
}

}  // namespace mrroc::ui
