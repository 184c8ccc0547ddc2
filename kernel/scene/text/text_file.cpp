#include "kernel/scene/text/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "kernel/scene/text/error.h"

namespace voxmelt::scene {
namespace {

// Holds the milliseconds of waiting for the next bytes of a pipe. A program that has it open for writing may
// think for a while.
constexpr int kPatience = 5000, kPatienceWithoutWriter = 1000;

thread_local FilesRead* innermost = nullptr;

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& file)  // a pipe without a writer must not hold us
      : value_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int value() const { return value_; }

 private:
  int value_;
};

}  // namespace

FilesRead::FilesRead() : outer_(innermost) { innermost = this; }
FilesRead::~FilesRead() { innermost = outer_; }
void FilesRead::note(const std::filesystem::path& file) {
  if (innermost != nullptr) innermost->files_.push_back(file);
}

std::string_view without_mark(std::string_view text, const Place& place, const std::string& file) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    fail_at(place, file + ": this is UTF-16; write the file as plain text or UTF-8");
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

std::string read_text_file(const std::filesystem::path& file, std::size_t limit, const std::string& where) {
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{}: error: cannot read {}: {}", where, file.string(), why));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail("it is a folder");
  const Descriptor open(file);
  if (open.value() < 0) fail(std::strerror(errno));
  FilesRead::note(file);

  // The file is read in pieces, so that reading an endless device stops at the limit.
  std::string text;
  const bool pipe = std::filesystem::is_fifo(file, ignored);
  std::array<char, 65536> piece;
  for (;;) {
    pollfd waiting{open.value(), POLLIN, 0};
    const bool silent = pipe && ::poll(&waiting, 1, kPatienceWithoutWriter) == 0;
    const ssize_t count = ::read(open.value(), piece.data(), piece.size());
    if (silent && count == 0) fail("nobody writes into this pipe");
    if (silent && count < 0 && ::poll(&waiting, 1, kPatience - kPatienceWithoutWriter) == 0)
      fail(fmt::format("nothing came through this pipe for {} seconds", kPatience / 1000));
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0) fail(std::strerror(errno));
    if (count == 0) return text;
    text.append(piece.data(), count);
    if (text.size() > limit) fail(fmt::format("larger than {} bytes", limit));
  }
}

}  // namespace voxmelt::scene
