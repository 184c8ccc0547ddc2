#include "kernel/scene/text/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>
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
  // Without a mark every other byte is 0, where the text is plain.
  const bool is_wide =
      text.size() >= 4 && (text[0] == 0) != (text[1] == 0) && (text[2] == 0) != (text[3] == 0);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") || is_wide)
    fail_at(place, file + ": this is UTF-16; write the file as plain text or UTF-8");
  if (text.starts_with("PK\3\4") || text.starts_with("\x1f\x8b"))
    fail_at(place, file + ": this is a packed file; unpack it first");
  if (text.starts_with("version https://git-lfs"))
    fail_at(place, file + ": this is a pointer of Git LFS; `git lfs pull` brings the file");
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

char line_end_of(std::string_view text) {
  return text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos ? '\r' : '\n';
}

std::string in_quotes(std::string_view word) {
  std::string text = "'";
  for (const char c : word.substr(0, 40)) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte < ' ' ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return text + "'";
}

std::optional<double> real_number_in(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error != std::errc::result_out_of_range) return number;
  const std::size_t exponent = word.find_first_of("eE");
  const bool is_small = exponent == std::string_view::npos ? word.find_first_not_of("-0.") > word.find('.')
                                                           : word.substr(exponent + 1).starts_with('-');
  const double size = is_small ? 0.0 : std::numeric_limits<double>::infinity();
  return word[0] == '-' ? -size : size;
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
  const auto size = std::filesystem::file_size(file, ignored);
  if (!ignored && size <= limit) text.reserve(size + 1);  // a text that grows is there twice
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
