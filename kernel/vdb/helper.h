// OpenVDB is in a program of its own, voxmelt-vdb. It is large, so a build may lack it. And files that
// OpenVDB cannot cope with end that program, not the one that reads them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace voxmelt::vdb {

// Is thrown where the program is missing, or could not do its work. The text is for the user.
class HelperError : public std::runtime_error {
 public:
  explicit HelperError(const std::string& message, bool out_of_space = false)
      : std::runtime_error(message), out_of_space_(out_of_space) {}
  bool out_of_space() const { return out_of_space_; }

 private:
  bool out_of_space_;
};

// Finds the program: as the environment's VOXMELT_VDB says, or beside this program, or on PATH. The result is
// empty if it is nowhere.
std::filesystem::path helper_program();
// Says what brings it.
std::string how_to_get_it();

class Helper {
 public:
  // Starts it with these arguments (stream.h). It ends when this process does.
  explicit Helper(const std::vector<std::string>& arguments);
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  ~Helper();  // kills it, unless it has ended

  // Gives it bytes. If it takes no more, its answer tells why.
  void send(std::string_view bytes);
  void end_of_input();

  // Returns its first line, which must begin with "ok", without that word.
  std::string answer();
  std::string line();
  // Takes as many bytes of what it gives. It throws if there are fewer.
  void receive(char* to, std::size_t bytes);
  // Waits until it ends. It throws unless it ends well.
  void finish();

 private:
  std::size_t take(char* to, std::size_t bytes);
  [[noreturn]] void fail_of_its_end();

  pid_t id_ = 0;
  int stream_ = -1;  // both its input and its output
};

}  // namespace voxmelt::vdb
