// The target is a page that says anything: a line each, of one page or (after a tilde) of a second one, while
// a small world goes on. Every line gets its steps and its picture before the next one is said.
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "app/view/session.h"
#include "tests/fuzz/small_world.h"
#include "tests/fuzz/target.h"
#include "voxmelt/voxmelt.h"

namespace {

using voxmelt::view::Client;
using voxmelt::view::Message;

constexpr const char* kRest = R"([pieces]
[flow]
law = "paper"
[camera]
width = 64
height = 64
)";
constexpr std::size_t kMostLines = 16;
constexpr std::string_view kNext = "next line, please";

// Counts that take the time of many lines: they are legal, and found nowhere else.
bool takes_long(std::string_view line) {
  constexpr int kMost = 128;
  for (const std::string_view word : {"step ", "speed ", "size "}) {
    if (!line.starts_with(word)) continue;
    for (std::size_t at = word.size(); at < line.size(); ++at) {
      int count = 0;
      const auto [rest, error] = std::from_chars(line.data() + at, line.data() + line.size(), count);
      if (error != std::errc() || rest == line.data() + at) continue;
      if (count > kMost) return true;
      at = static_cast<std::size_t>(rest - line.data());
    }
  }
  return line.find_first_of("eE.") != line.npos && (line.starts_with("s") || line.starts_with("speed"));
}

std::deque<std::string> lines_of(std::string_view text) {
  std::deque<std::string> lines;
  while (!text.empty() && lines.size() < kMostLines) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (!line.empty() && !takes_long(line.substr(line.starts_with('~') ? 1 : 0))) lines.emplace_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// Returns the head of a message, and sees that it is one.
nlohmann::json head_of(const Message& message) {
  std::string_view text = message.bytes;
  if (message.kind != Message::Kind::text) {
    std::uint32_t length = 0;
    if (text.size() < 4) voxmelt::fuzz::found("a message without the length of its head");
    for (std::size_t i = 0; i < 4; ++i)
      length |= std::uint32_t{static_cast<unsigned char>(text[i])} << (8 * i);
    if (text.size() - 4 < length) voxmelt::fuzz::found("a head that is longer than its message");
    text = text.substr(4, length);
  }
  nlohmann::json head = nlohmann::json::parse(text, nullptr, false);
  if (!head.is_object() || !head["type"].is_string()) voxmelt::fuzz::found("a message that is no JSON");
  if (head["type"] == "books")
    for (const auto& drift : head["drift"])
      if (drift != "0") voxmelt::fuzz::found("the ledgers drift");
  return head;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  if (size > 2000) return 0;
  static const auto file = fuzz::write("scene.toml", std::string(fuzz::kSmallWorld) + kRest);
  std::deque<std::string> lines = lines_of(fuzz::text_of(data, size));
  const auto open = [](const std::filesystem::path& checkpoint) {
    return Simulation(checkpoint.empty() ? file : checkpoint, {{}, "reference", 1});
  };
  view::Session* speaker = nullptr;
  const auto hear = [&](std::optional<Client> client, const view::MessagePtr& message) {
    const nlohmann::json head = head_of(*message);
    if (head["type"] != "refused" || head["line"] != std::string(kNext) || client != Client{2}) return;
    if (lines.empty()) return speaker->stop();
    const bool other = lines.front().starts_with('~');
    speaker->say(other ? 2 : 1, lines.front().substr(other ? 1 : 0));
    speaker->say(2, std::string(kNext));
    lines.pop_front();
  };
  view::Session session(open, "scene.toml", hear);
  speaker = &session;
  session.come(1);
  session.come(2);
  session.say(2, std::string(kNext));
  session.run();
  return 0;
}
