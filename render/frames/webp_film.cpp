#include "render/frames/webp_film.h"

#include <cerrno>
#include <cstring>
#include <exception>
#include <system_error>
#include <utility>

#include "render/frames/webp_bytes.h"

namespace voxmelt::render {
namespace {

// Numbers of a WebP file have their lowest byte first.
std::string number(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

// A chunk of a RIFF file. All contents here have an even length, so that none is padded.
std::string chunk(const char* name, const std::string& content) {
  return name + number(content.size(), 4) + content;
}

bool same_row(const Image& a, const Image& b, int y) {
  return std::memcmp(&a.at(0, y), &b.at(0, y), sizeof(Rgb) * a.width) == 0;
}

// Returns the smallest part that holds all pixels which differ. A frame's place is even. Where nothing
// differs, a pixel stands for it: a film has all of its frames.
Rectangle changed(const Image& before, const Image& now) {
  int top = 0, bottom = now.height;
  while (top < bottom && same_row(before, now, top)) ++top;
  if (top == bottom) return {0, 0, 1, 1};
  while (same_row(before, now, bottom - 1)) --bottom;
  int left = now.width, right = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = 0; x < left; ++x)
      if (before.at(x, y) != now.at(x, y)) left = x;
    for (int x = now.width - 1; x >= right; --x)
      if (before.at(x, y) != now.at(x, y)) right = x + 1;
  }
  left -= left % 2;
  top -= top % 2;
  return {left, top, right - left, bottom - top};
}

constexpr std::uint64_t kRiffHeader = 8;              // name and size, which counts what follows
constexpr std::uint64_t kLongest = 0xffff'fffe;       // of that size
constexpr char kAnimation = 2, kTakesThePlaceOf = 2;  // flags of VP8X, and of ANMF: nothing is blended

}  // namespace

WebpFilm::WebpFilm(std::filesystem::path file, int frames_per_second, bool lossless)
    : file_(std::move(file)),
      beside_(file_.string() + ".part"),
      frames_per_second_(frames_per_second),
      lossless_(lossless) {}

WebpFilm::~WebpFilm() {
  if (stream_) give_up("");
}

void WebpFilm::give_up(const std::string& problem) {
  problem_ = problem;
  stream_.reset();
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
}

void WebpFilm::write(const std::string& bytes) {
  if (!problem_.empty()) return;
  if (bytes_ + bytes.size() > kRiffHeader + kLongest) return give_up("a WebP file has at most 4 GiB");
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size())
    return give_up(std::string("it cannot be written: ") + std::strerror(errno));
  bytes_ += bytes.size();
}

// The size of all is not known yet.
void WebpFilm::begin(const Image& frame) {
  if (frame.width > kWidestWebp || frame.height > kWidestWebp)
    return give_up("a WebP picture has at most " + std::to_string(kWidestWebp) + " pixels a side");
  stream_.reset(std::fopen(beside_.c_str(), "wb"));
  if (!stream_) return give_up(std::string("it cannot be written: ") + std::strerror(errno));
  const std::string flags{kAnimation, 0, 0, 0};
  write("RIFF" + number(0, 4) + "WEBP" +
        chunk("VP8X", flags + number(frame.width - 1, 3) + number(frame.height - 1, 3)) +
        chunk("ANIM", number(0xffff'ffff, 4) + number(0, 2)));  // on white, again and again
}

// The frames' ends are those of exact times, rounded to milliseconds: nothing adds up.
std::uint32_t WebpFilm::milliseconds() const {
  const auto end = [&](std::uint64_t frame) {
    return (2000 * frame + frames_per_second_) / (2 * frames_per_second_);
  };
  return static_cast<std::uint32_t>(end(frames_ + 1) - end(frames_));
}

void WebpFilm::add(const Image& frame) {
  if (frames_ == 0 && problem_.empty()) begin(frame);
  if (!problem_.empty()) return;
  try {
    const Rectangle part = frames_ == 0 ? Rectangle{0, 0, frame.width, frame.height} : changed(last_, frame);
    write(chunk("ANMF", number(part.x / 2, 3) + number(part.y / 2, 3) + number(part.width - 1, 3) +
                            number(part.height - 1, 3) + number(milliseconds(), 3) + kTakesThePlaceOf +
                            webp_bytes(frame, part, lossless_)));
    last_ = frame;
    ++frames_;
  } catch (const std::exception& error) {
    give_up(error.what());
  }
}

std::optional<std::string> WebpFilm::finish() {
  if (frames_ == 0 && problem_.empty()) problem_ = "there are no frames";
  if (problem_.empty() && std::fseek(stream_.get(), 4, SEEK_SET) != 0)
    give_up(std::string("it cannot be written: ") + std::strerror(errno));
  const std::uint64_t bytes = bytes_;
  write(number(bytes - kRiffHeader, 4));
  if (!problem_.empty()) return problem_;

  errno = 0;
  if (std::fclose(stream_.release()) != 0) {
    give_up(std::string("it cannot be written: ") + std::strerror(errno));
    return problem_;
  }
  std::error_code error;
  std::filesystem::rename(beside_, file_, error);
  if (!error) return std::nullopt;
  give_up(error.message());
  return problem_;
}

}  // namespace voxmelt::render
