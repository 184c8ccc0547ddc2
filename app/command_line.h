// The command line holds commands with their options, the checks of their values, and the texts of --help.
// Only the source of this header knows CLI11, which takes ten seconds to compile.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace voxmelt::app {

// Reports bad usage, whether of the command line or of what it asks for (an impossible size). The exit code
// is 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Is an option of a command, a flag, or a value without a name. It is a handle: copies are of the same
// option. Each function that describes the option returns it, so that calls can be chained.
class Option {
 public:
  Option required(bool is = true) const;
  Option excludes(Option other) const;  // both exclude each other

  // These functions set the texts of --help.
  Option shows_default() const;
  Option described_as(const std::string& description) const;
  Option written_as(const std::string& value) const;  // "KEY=VALUE" for the type's name

  // These functions set how many values the option takes. A list takes as many as come, unless more is said.
  Option one_each_time() const;  // a list may be repeated
  Option any_number() const;     // zero values are enough
  Option separated_by(char sign) const;

  // These functions set the checks of a value.
  Option one_of(const std::vector<std::string>& names) const;
  Option not_negative() const;
  Option within(int low, int high) const;
  Option within(std::uint32_t low, std::uint32_t high) const;
  Option within(std::uint64_t low, std::uint64_t high) const;
  Option within(double low, double high) const;  // refuses "nan"

  bool given() const;  // known once the command line is read

 private:
  friend class Command;
  explicit Option(CLI::Option* option) : option_(option) {}
  CLI::Option* option_;
};

// Is a command of the program, and a handle as well.
class Command {
 public:
  // Adds an option. `name` begins with "--", or names a value by its place. The given value is put into
  // `value`, which lives as long as the work of runs(). A Value is a number, a text, a list of texts, or a
  // std::optional of one of these. The source lists the types.
  template <class Value>
  Option option(const std::string& name, Value& value, const std::string& description) const;
  // Adds a flag. "--name" sets it, "!--name" clears it.
  Option flag(const std::string& name, bool& value, const std::string& description) const;

  Option find(const std::string& name) const;  // one that was declared before
  std::set<std::string> given() const;         // names of options, once the command line is read

  void footer(const std::string& text) const;
  // Sets the work of the command, which is done if the command is chosen. It returns the exit code.
  void runs(std::function<int()> work) const;

 private:
  friend class CommandLine;
  Command(CLI::App* command, std::function<int()>* chosen) : command_(command), chosen_(chosen) {}
  CLI::App* command_;
  std::function<int()>* chosen_;
};

// Owns commands and options, so it outlives all handles.
class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& introduction, const std::string& version);
  ~CommandLine();

  Command add(const std::string& name, const std::string& description);

  // Returns the work of the chosen command, or nothing if help or the version was asked for and printed.
  // Throws UsageError.
  std::function<int()> read(int argc, const char* const* argv);

 private:
  void check_command(const std::string& given) const;
  std::unique_ptr<CLI::App> program_;
  std::function<int()> chosen_;
};

}  // namespace voxmelt::app
