#include "base/command_line.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <deque>
#include <ostream>
#include <string_view>
#include <type_traits>

#include "base/closest_match.hpp"
#include "base/command_hint.hpp"
#include "base/command_words.hpp"
#include "base/fault.hpp"
#include "base/program.hpp"

namespace mrroc {
namespace {

/// @return the long options of a command line, as they are written
std::vector<std::string> long_options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* o : app.get_options())
    for (const std::string& name : o->get_lnames()) names.push_back("--" + name);
  return names;
}

void add_options(const CLI::App& app, WordSet& known) {
  for (const std::string& name : long_options_of(app)) known.insert(name);
}

/// One of some words; of any other the nearest is told.
struct OneOf : CLI::IsMember {
  explicit OneOf(const std::vector<std::string>& words) : CLI::IsMember(words) {
    func_ = [words, is = func_](std::string& word) {
      std::string wrong = is(word);
      if (!wrong.empty()) wrong += did_you_mean(word, WordSet(words.begin(), words.end()));
      return wrong;
    };
  }
};

/// @return bad_usage for words that no command of the line knows, better than what CLI11 says where that is possible
FaultError unknown_word(const CLI::App& app, const WordSet& orders, const CLI::Error& e) {
  const std::vector<std::string> words = app.remaining(true);
  if (!words.empty() && is_setting(words.front()) && app.get_option_no_throw("--set"))
    return {FaultCode::bad_usage, fmt::format("'{}' stands by itself", words.front()),
            fmt::format("give --set {}", words.front())};
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    WordSet options;
    add_options(app, options);
    for (const CLI::App* command : app.get_subcommands()) add_options(*command, options);
    const std::string name = word.substr(0, word.find('='));
    return no_such_word("option", name, closest_match(name, options));
  }
  WordSet commands;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    if (!orders.contains(command->get_name())) commands.insert(command->get_name());
  const bool none = commands.empty() && orders.empty();
  if (words.empty() || words.front().starts_with("-")) return {FaultCode::bad_usage, e.what()};
  if (none || !app.get_subcommands().empty())
    return {FaultCode::bad_usage, fmt::format("no option and no command takes the word '{}'", words.front())};
  return no_such_word("command", words.front(), closest_match(words.front(), commands, orders));
}

/// @return an option or a place of the line with what it is for: "RUN (the run folder)"
std::string with_description(const CLI::Option& o) {
  std::string name = o.get_name();
  if (o.get_positional())
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  return o.get_description().empty() ? name : fmt::format("{} ({})", name, o.get_description());
}

/// The range of an option, with the help of CLI11's and words of its own.
class Range final : public CLI::Range {
 public:
  template <class Number>
  Range(Number low, Number high) : CLI::Range(low, high) {
    func_ = [low, high](const std::string& text) -> std::string {
      Number value{};
      if (!CLI::detail::lexical_cast(text, value)) return no_number<Number>(text);
      if (value >= low && value <= high) return {};
      return fmt::format("{} is outside {}..{}", text, low, high);
    };
  }

  template <class Number>
  static std::string no_number(const std::string& text) {
    return fmt::format("'{}' is no {}number", text, std::is_integral_v<Number> ? "whole " : "");
  }
};

/// @return bad_usage for a line that CLI11 refuses: words that do not exist or are missing are named, with what to type
FaultError wrong_words(const CLI::App& app, const WordSet& orders, const CLI::Error& e,
                       const Examples& examples) {
  const CLI::App* at = &app;  // the command that was reached
  std::string command = app.get_name();
  for (auto inner = at->get_subcommands(); !inner.empty(); inner = at->get_subcommands()) {
    at = inner.back();
    command += (command.empty() ? "" : " ") + at->get_name();
  }
  const bool required = dynamic_cast<const CLI::RequiredError*>(&e) != nullptr;
  if (dynamic_cast<const CLI::ExtrasError*>(&e) || (required && !app.remaining(true).empty()))
    return unknown_word(app, orders, e);
  if (required) {
    std::vector<std::string> missing;
    for (const CLI::Option* o : at->get_options())
      if (o->get_required() && o->count() == 0) missing.push_back(with_description(*o));
    if (missing.empty() && at->get_subcommands(nullptr).empty()) return {FaultCode::bad_usage, e.what()};
    if (missing.empty()) {
      for (const CLI::App* inner : at->get_subcommands(nullptr)) missing.push_back(inner->get_name());
      return {FaultCode::bad_usage, fmt::format("a command is missing; there are {}", listed(missing)),
              what_to_type(examples, command, "")};
    }
    return {FaultCode::bad_usage,
            fmt::format("{} {} missing", listed(missing), missing.size() == 1 ? "is" : "are"),
            what_to_type(examples, command, "")};
  }
  // "--session: 1 required NAME missing", "--url requires --session"
  constexpr std::string_view kNotConverted = "Could not convert: ";  // and "--option = word"
  const std::string said = e.what(), name = said.substr(0, said.find_first_of(" :"));
  const CLI::Option* option = at->get_option_no_throw(name);
  if (!option) option = app.get_option_no_throw(name);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&e) && option && option->count() == 0)
    return {FaultCode::bad_usage, fmt::format("a value is missing behind {}", with_description(*option)),
            what_to_type(examples, command, fmt::format(" {} ", name))};
  if (dynamic_cast<const CLI::ConversionError*>(&e) && said.starts_with(kNotConverted)) {
    const std::size_t equals = said.find(" = ");
    return {FaultCode::bad_usage,
            fmt::format("{}: {}", said.substr(kNotConverted.size(), equals - kNotConverted.size()),
                        Range::no_number<double>(said.substr(equals + 3))),
            what_to_type(Examples{}, command, "")};
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&e) && option && said.find("At Most") != std::string::npos)
    return {FaultCode::bad_usage, fmt::format("{} is given {} times; once is enough", name, option->count()),
            what_to_type(Examples{}, command, "")};
  constexpr std::string_view kExcludes = " excludes ";
  if (const std::size_t at_word = said.find(kExcludes);
      dynamic_cast<const CLI::ExcludesError*>(&e) && at_word != std::string::npos)
    return {FaultCode::bad_usage,
            fmt::format("{} and {} cannot be given together", name, said.substr(at_word + kExcludes.size())),
            what_to_type(Examples{}, command, "")};
  const bool requires_another = dynamic_cast<const CLI::RequiresError*>(&e) != nullptr;
  return {FaultCode::bad_usage, said,
          what_to_type(requires_another ? examples : Examples{}, command, fmt::format(" {} ", name))};
}

}  // namespace

struct Option::Held {
  CLI::Option& option;
};

Option Option::type_name(const std::string& name) const {
  held_->option.type_name(name);
  return *this;
}

Option Option::about(const std::string& text) const {
  held_->option.description(text);
  return *this;
}

Option Option::show_default() const {
  held_->option.capture_default_str();
  return *this;
}

Option Option::required(bool is) const {
  held_->option.required(is);
  return *this;
}

Option Option::value_optional() const {
  held_->option.expected(0, 1);
  return *this;
}

Option Option::delimiter(char between) const {
  held_->option.delimiter(between);
  return *this;
}

Option Option::one_of(const std::vector<std::string>& values) const {
  held_->option.check(OneOf(values));
  return *this;
}

Option Option::range(int low, int high) const {
  held_->option.check(Range(low, high));
  return *this;
}

Option Option::range(double low, double high) const {
  held_->option.check(Range(low, high));
  return *this;
}

Option Option::check(const TextFunction& look) const {
  held_->option.check([look](const std::string& text) -> std::string {
    try {
      look(text);
      return {};
    } catch (const WrongValue& e) {
      return e.what();
    }
  });
  return *this;
}

Option Option::excludes(const Option& other) const {
  held_->option.excludes(&other.held_->option);
  return *this;
}

Option Option::needs(const Option& other) const {
  held_->option.needs(&other.held_->option);
  return *this;
}

bool Option::given() const { return held_->option.count() > 0; }

struct CommandLine::Parts {
  Option add(CLI::Option* option) { return Option(options.emplace_back(Option::Held{*option})); }

  std::unique_ptr<CLI::App> own;  ///< of the whole line; those of subcommands belong to the line above
  CLI::App& app;
  std::deque<Option::Held> options{};
  std::vector<std::unique_ptr<CommandLine>> subcommands{};
  WordSet orders{};  ///< those of the subcommands that order() has added
};

CommandLine::CommandLine(const std::string& about, const std::string& name) {
  auto app = std::make_unique<CLI::App>(about, name);
  CLI::App& whole = *app;
  parts_ = std::make_unique<Parts>(Parts{std::move(app), whole});
}

CommandLine::CommandLine(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
CommandLine::~CommandLine() = default;

template <OptionValue Value>
Option CommandLine::option(const std::string& name, Value& value, const std::string& about) {
  return parts_->add(parts_->app.add_option(name, value, about));
}

template Option CommandLine::option(const std::string&, std::string&, const std::string&);
template Option CommandLine::option(const std::string&, std::filesystem::path&, const std::string&);
template Option CommandLine::option(const std::string&, int&, const std::string&);
template Option CommandLine::option(const std::string&, std::int64_t&, const std::string&);
template Option CommandLine::option(const std::string&, double&, const std::string&);
template Option CommandLine::option(const std::string&, std::optional<std::string>&, const std::string&);
template Option CommandLine::option(const std::string&, std::optional<double>&, const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::filesystem::path>&,
                                    const std::string&);

Option CommandLine::option(const std::string& name, const TextFunction& take, const std::string& about) {
  const auto told = [name, take](const std::string& text) {
    try {
      take(text);
    } catch (const WrongValue& e) {
      throw CLI::ValidationError(name, e.what());
    }
  };
  return parts_->add(parts_->app.add_option_function<std::string>(name, told, about));
}

Option CommandLine::ignored_option(const std::string& name, const std::string& about) {
  return parts_->add(parts_->app.add_option(name, about));
}

Option CommandLine::numbered(const std::string& name, const std::map<std::string, std::uint8_t>& numbers,
                             const std::function<void(std::uint8_t)>& take, const std::string& about) {
  std::vector<std::string> words;
  for (const auto& [word, number] : numbers) words.push_back(word);
  const auto told = [numbers, take](const std::string& word) { take(numbers.at(word)); };
  return parts_->add(parts_->app.add_option_function<std::string>(name, told, about)->check(OneOf(words)));
}

Option CommandLine::flag(const std::string& name, bool& value, const std::string& about) {
  return parts_->add(parts_->app.add_flag(name, value, about));
}

Option CommandLine::flag(const std::string& name, const std::string& about) {
  return parts_->add(parts_->app.add_flag_callback(
      name, [] {}, about));
}

Option CommandLine::named(const std::string& name) {
  const CLI::Option* const wanted = parts_->app.get_option_no_throw(name);
  const auto found =
      std::ranges::find_if(parts_->options, [&](const auto& held) { return &held.option == wanted; });
  if (found == parts_->options.end()) throw std::out_of_range("there is no option " + name);
  return Option(*found);
}

void CommandLine::footer(const std::string& text) { parts_->app.footer(text); }

CommandLine& CommandLine::subcommand(const std::string& name, const std::string& about) {
  auto parts = std::make_unique<Parts>(Parts{nullptr, *parts_->app.add_subcommand(name, about)});
  parts_->subcommands.emplace_back(new CommandLine(std::move(parts)));
  return *parts_->subcommands.back();
}

CommandLine& CommandLine::order(const std::string& name, const std::string& about) {
  parts_->orders.insert(name);
  return subcommand(name, about);
}

void CommandLine::take_one_subcommand(bool required) { parts_->app.require_subcommand(required ? 1 : 0, 1); }

void CommandLine::take_options_anywhere() { parts_->app.fallthrough(); }

void CommandLine::take_words_unread() {
  parts_->app.prefix_command()->set_help_flag();
  parts_->app.fallthrough(false);
}

void CommandLine::when_given(const std::function<void()>& what) { parts_->app.callback(what); }

std::vector<std::string> CommandLine::remaining() const { return parts_->app.remaining(); }

std::string CommandLine::name() const { return parts_->app.get_name(); }

std::string CommandLine::about() const { return parts_->app.get_description(); }

std::vector<std::string> CommandLine::long_options() const { return long_options_of(parts_->app); }

std::vector<const CommandLine*> CommandLine::subcommands() const {
  std::vector<const CommandLine*> all;
  for (const auto& command : parts_->subcommands) all.push_back(command.get());
  return all;
}

std::optional<std::string> CommandLine::help_asked(const std::vector<std::string>& words) const {
  if (!asks_for_help(words)) return std::nullopt;
  const CLI::App* command = &parts_->app;
  std::string before;
  for (const std::string& word : words)
    for (const CLI::App* inner : command->get_subcommands(nullptr))
      if (inner->get_name() == word) {
        before += (before.empty() ? "" : " ") + command->get_name();
        command = inner;
        break;
      }
  return command_hint(command->help(before));
}

std::optional<std::string> CommandLine::help_asked(int argc, const char* const* argv) {
  if (name().empty()) parts_->app.name(this_program().filename().string());
  return help_asked(std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
}

void CommandLine::refuse_unknown_options(int argc, const char* const* argv) const {
  WordSet known;
  add_options(parts_->app, known);
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--") return;
    const std::string name = word.substr(0, word.find('='));
    if (name.starts_with("--") && !known.contains(name))
      throw no_such_word("option", name, closest_match(name, known));
  }
}

void CommandLine::parse(int argc, const char* const* argv, const Examples& examples) {
  try {
    parts_->app.parse(argc, argv);
  } catch (const CLI::Error& e) {
    throw wrong_words(parts_->app, parts_->orders, e, examples);
  }
}

void CommandLine::parse(const std::vector<std::string>& words, const Examples& examples) {
  try {
    parts_->app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Error& e) {
    throw wrong_words(parts_->app, parts_->orders, e, examples);
  }
}

std::optional<std::string> CommandLine::parse_or_help(int argc, const char* const* argv,
                                                      const Examples& examples) {
  try {
    parts_->app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::CallForHelp&) {
    return parts_->app.help();
  } catch (const CLI::Error& e) {
    throw wrong_words(parts_->app, parts_->orders, e, examples);
  }
}

std::optional<int> CommandLine::parse_words(const std::vector<std::string>& words, std::ostream& out,
                                            std::ostream& err, const Examples& examples) {
  if (const auto help = help_asked(words)) {
    out << *help;
    return 0;
  }
  try {
    parse(words, examples);
    return std::nullopt;
  } catch (const FaultError& e) {
    if (e.fault().code != FaultCode::bad_usage) throw;
    err << e.error_line() << std::endl;
    return exit_status(FaultCode::bad_usage);
  }
}

}  // namespace mrroc
