#include "app/command_line.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <optional>
#include <utility>

namespace voxmelt::app {
namespace {

// CLI11 takes an empty value of many options as not given.
void check_no_empty_values(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string given = argv[i];
    const bool assigned = given.starts_with("--") && given.size() > 3 && given.find('=') == given.size() - 1;
    if (given.empty() || assigned)
      throw UsageError("error: an empty value" + (assigned ? " of " + given.substr(0, given.size() - 1)
                                                  : i > 1  ? " after " + std::string(argv[i - 1])
                                                           : std::string()));
  }
}

}  // namespace

Option Option::required(bool is) const { return Option(option_->required(is)); }

Option Option::excludes(Option other) const { return Option(option_->excludes(other.option_)); }

Option Option::shows_default() const { return Option(option_->capture_default_str()); }

Option Option::described_as(const std::string& description) const {
  return Option(option_->description(description));
}

Option Option::written_as(const std::string& value) const { return Option(option_->type_name(value)); }

Option Option::one_each_time() const { return Option(option_->allow_extra_args(false)); }

Option Option::any_number() const { return Option(option_->expected(0, -1)); }

Option Option::separated_by(char sign) const { return Option(option_->delimiter(sign)); }

Option Option::one_of(const std::vector<std::string>& names) const {
  return Option(option_->check(CLI::IsMember(names)));
}

Option Option::not_negative() const { return Option(option_->check(CLI::NonNegativeNumber)); }

Option Option::within(int low, int high) const { return Option(option_->check(CLI::Range(low, high))); }

Option Option::within(std::uint32_t low, std::uint32_t high) const {
  return Option(option_->check(CLI::Range(low, high)));
}

Option Option::within(std::uint64_t low, std::uint64_t high) const {
  return Option(option_->check(CLI::Range(low, high)));
}

// CLI::Range lets "nan" through.
Option Option::within(double low, double high) const {
  const auto problem = [low, high](const std::string& text) {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return good ? std::string() : fmt::format("{} is not a number from {} to {}", text, low, high);
  };
  return Option(option_->check(CLI::Validator(problem, fmt::format("NUMBER in [{} - {}]", low, high))));
}

bool Option::given() const { return option_->count() > 0; }

template <class Value>
Option Command::option(const std::string& name, Value& value, const std::string& description) const {
  return Option(command_->add_option(name, value, description));
}

// Commands have values of these types.
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, std::uint32_t&, const std::string&) const;
template Option Command::option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::uint32_t>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::uint64_t>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::int64_t>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::string>&, const std::string&) const;

Option Command::flag(const std::string& name, bool& value, const std::string& description) const {
  return Option(command_->add_flag(name, value, description));
}

Option Command::find(const std::string& name) const { return Option(command_->get_option(name)); }

std::set<std::string> Command::given() const {
  std::set<std::string> names;
  for (const CLI::Option* option : command_->get_options())
    if (option->count() > 0) names.insert(option->get_name());
  return names;
}

void Command::footer(const std::string& text) const { command_->footer(text); }

void Command::runs(std::function<int()> work) const {
  command_->callback([chosen = chosen_, work = std::move(work)] { *chosen = work; });
}

CommandLine::CommandLine(const std::string& name, const std::string& introduction, const std::string& version)
    : program_(std::make_unique<CLI::App>(introduction, name)) {
  program_->set_version_flag("--version", version);
  program_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

Command CommandLine::add(const std::string& name, const std::string& description) {
  return {program_->add_subcommand(name, description), &chosen_};
}

// The message of CLI11 would say only that a subcommand is required.
void CommandLine::check_command(const std::string& given) const {
  if (given.starts_with('-')) return;
  std::string known;
  for (const CLI::App* command : std::as_const(*program_).get_subcommands({})) {
    if (command->get_name() == given) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw UsageError("error: unknown command '" + given + "'; there are " + known);
}

std::function<int()> CommandLine::read(int argc, const char* const* argv) {
  check_no_empty_values(argc, argv);
  if (argc > 1) check_command(argv[1]);
  try {
    program_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0)
      throw UsageError(std::string("error: ") + error.what() + "; --help says more");
    program_->exit(error);  // prints help, or the version
    return nullptr;
  }
  return chosen_;
}

}  // namespace voxmelt::app
