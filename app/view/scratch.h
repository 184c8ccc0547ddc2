// A file that only this program sees, and that goes with it.
#pragma once

#include <filesystem>
#include <string>

namespace voxmelt::view {

class Scratch {
 public:
  Scratch();  // throws OutputError
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path file() const { return folder_ / "file"; }
  std::string bytes() const;
  void write(const std::string& bytes) const;  // throws OutputError

 private:
  std::filesystem::path folder_;
};

}  // namespace voxmelt::view
