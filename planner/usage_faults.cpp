#include "planner/usage_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "terrain/document.hpp"

namespace surefoot::planner {

namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

/// The option that a misspelt word stands for: a letter off, cut short, or with one dash only. "" if none is near.
std::string option_meant_by(const std::string& word, const std::vector<std::string>& options) {
  if (!word.starts_with("--")) {
    const bool known = std::find(options.begin(), options.end(), "-" + word) != options.end();
    return known ? "-" + word : "";
  }
  const auto longer = std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.starts_with(word); });
  return longer != options.end() && word.size() > 3 ? *longer : terrain::near_miss(word, options);
}

/// What an option stands for that is given without a command.
std::string option_without_command(const CLI::App& app, const std::string& option) {
  const std::vector<std::string> commands = command_names(app);
  const std::string word = option.substr(std::min(option.find_first_not_of('-'), option.size()));
  if (const std::string meant = option_meant_by(option, {"--help", "--version"}); !meant.empty())
    return fmt::format("unknown option {}, did you mean {}?", option, meant);
  if (std::find(commands.begin(), commands.end(), word) != commands.end())
    return fmt::format("unknown option {}, did you mean surefoot {}?", option, word);
  return fmt::format("expected a command before {}: {} (surefoot --help tells more)", option,
                     fmt::join(commands, ", "));
}

/// The names of an option, as they are written.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

/// Of a word that may be --option=value the option.
std::string option_of(std::string_view word) { return std::string(word.substr(0, word.find('='))); }

/// An option of the command that stands before it; "" if none does.
std::string option_before_command(const CLI::App& command, int count, char** words) {
  for (int i = 1; i < count && words[i] != command.get_name(); ++i)
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : names_of(*option))
        if (name == option_of(words[i])) return name;
  return "";
}

/// "--svg: At Most 1 required but received 2", "--svg: 1 required FILE missing"
std::string wrong_count(const std::string& message) {
  const std::string option = message.substr(0, message.find(':'));
  if (message.find("At Most 1 required") != std::string::npos) return option + " is given more than once";
  const std::size_t missing = message.rfind(" missing"), before = message.rfind(' ', missing - 1);
  if (missing == std::string::npos || before == std::string::npos) return message;
  return fmt::format("{}: expected {} behind it", option, message.substr(before + 1, missing - before - 1));
}

/// Words that the command knows nothing of, with what may have been meant.
std::string extra_words(const CLI::App& app, const CLI::App& command, int count, char** words) {
  if (const std::string early = option_before_command(command, count, words); !early.empty())
    return fmt::format("{} belongs behind the command: surefoot {} ... {} ...", early, command.get_name(), early);
  std::vector<std::string> options{"--help", "--version"};
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  for (int i = 1; i < count; ++i) {
    const std::string word = option_of(words[i]);
    if (!word.starts_with("-") || std::find(options.begin(), options.end(), word) != options.end()) continue;
    if (const std::string meant = option_meant_by(word, options); !meant.empty())
      return fmt::format("unknown option {}, did you mean {}?", word, meant);
  }
  constexpr std::size_t most = 3;  // words that are named
  const std::vector<std::string> extra = app.remaining(true);
  const std::vector<std::string> named(extra.begin(), extra.begin() + std::min(extra.size(), most));
  return fmt::format("not expected here: {}{} (surefoot {} --help tells what is)", fmt::join(named, ", "),
                     extra.size() <= most       ? ""
                     : extra.size() == most + 1 ? " and 1 more word"
                                                : fmt::format(" and {} more words", extra.size() - most),
                     command.get_name());
}

}  // namespace

std::string command_missing(const CLI::App& app) {
  return fmt::format("a command is missing: {} (surefoot --help tells more)", fmt::join(command_names(app), ", "));
}

std::string usage_fault(const CLI::App& app, const CLI::ParseError& fault, int count, char** words) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App* chosen = parsed.empty() ? nullptr : parsed.front();
  if (count > 1 && std::string_view(words[1]) == "help") return "expected surefoot --help, or surefoot COMMAND --help";
  if (count > 1 && std::string_view(words[1]) == "version") return "expected surefoot --version";
  if (chosen == nullptr && count > 1 && words[1][0] != '-') {
    const std::vector<std::string> commands = command_names(app);
    const std::string meant = terrain::near_miss(words[1], commands);
    return fmt::format("unknown command '{}'{}; there are {}", words[1],
                       meant.empty() ? "" : fmt::format(", did you mean {}?", meant), fmt::join(commands, ", "));
  }
  if (chosen == nullptr) return count > 1 ? option_without_command(app, words[1]) : command_missing(app);
  std::string message = fault.what();
  const std::string unconverted = "Could not convert: ";  // "Could not convert: --time-limit = 1min"
  if (const auto equals = message.find(" = "); message.starts_with(unconverted) && equals != std::string::npos)
    return fmt::format("{}: found {}, expected a {}number",
                       message.substr(unconverted.size(), equals - unconverted.size()), message.substr(equals + 3),
                       is_number(message.substr(equals + 3)) ? "whole " : "");
  if (dynamic_cast<const CLI::ExtrasError*>(&fault) != nullptr) return extra_words(app, *chosen, count, words);
  if (dynamic_cast<const CLI::RequiredError*>(&fault) != nullptr && message.ends_with(" is required"))
    return fmt::format("{} is missing (surefoot {} --help tells more)", message.substr(0, message.find(' ')),
                       chosen->get_name());
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&fault) != nullptr) return wrong_count(message);
  return message;
}

std::string equals_sign(const CLI::App& app, int count, char** words) {
  const std::vector<std::string> commands = command_names(app);
  const CLI::App* command = nullptr;
  for (int i = 1; i < count && std::string_view(words[i]) != "--"; ++i) {
    const std::string_view word = words[i];
    if (command == nullptr && std::find(commands.begin(), commands.end(), word) != commands.end())
      command = app.get_subcommand(std::string(word));
    if (command == nullptr || word.size() < 3 || word[0] != '-' || word[1] == '-' || word[2] != '=') continue;
    const CLI::Option* option = command->get_option_no_throw(std::string(word.substr(0, 2)));
    if (option == nullptr) continue;
    if (option->get_expected_max() == 0) return fmt::format("{}: {} takes no value", word, word.substr(0, 2));
    return fmt::format("{}: behind {} stands a space, no equals sign", word, word.substr(0, 2));
  }
  return "";
}

std::string overflowing_argument(const CLI::App& app) {
  const auto overflows = [](const std::string& given, bool whole) {
    char* end = nullptr;
    errno = 0;
    if (whole) std::strtoll(given.c_str(), &end, 0);
    else if (const double cut = std::strtod(given.c_str(), &end); !std::isinf(cut) && cut != 0) errno = 0;
    return errno == ERANGE && *end == '\0';
  };
  for (const CLI::App* command : app.get_subcommands())
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_type_name().size() != 1) continue;  // other types than numbers have longer names
      const bool whole = option->get_type_name() == whole_number;
      for (const std::string& given : option->results())
        if (overflows(given, whole))
          return fmt::format("{}: found {}, expected a {}", option->get_name(), terrain::shown(given),
                             whole ? "whole number between -2^63 and 2^63" : "number such as 0.25 or 1e-3");
    }
  return "";
}

std::string empty_argument(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands())
    for (const CLI::Option* option : command->get_options())
      for (const std::string& given : option->results())
        if (given.empty()) return fmt::format("{} is an empty text", option->get_name());
  return "";
}

}  // namespace surefoot::planner
