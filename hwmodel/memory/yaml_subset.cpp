#include "hwmodel/memory/yaml_subset.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace voxmelt::hwmodel {
namespace {

using Kind = scene::Value::Kind;

struct Line {
  std::uint32_t number = 0;  // from 1
  std::size_t indent = 0;
  std::string text;  // without indentation, comment and trailing space
};

class Parser {
 public:
  Parser(const std::string& text, std::shared_ptr<const scene::Origin> origin) : origin_(std::move(origin)) {
    std::istringstream stream(text);
    std::string line;
    for (std::uint32_t number = 1; std::getline(stream, line); ++number) add(number, line);
  }

  scene::Value document() {
    if (lines_.empty()) return table({});
    scene::Value value = map(lines_.front().indent);
    if (at_ < lines_.size()) fail(lines_[at_], "its indentation is that of no line before");
    return value;
  }

 private:
  [[noreturn]] void fail(const Line& line, const std::string& why) const {
    scene::fail_at(place(line), "\"" + line.text + "\" is not read as YAML here: " + why);
  }
  scene::Place place(const Line& line) const {
    return {origin_, line.number, static_cast<std::uint32_t>(line.indent + 1)};
  }
  scene::Value table(const scene::Place& place) const {
    scene::Value value;
    value.place = value.key_place = place.origin ? place : scene::Place{origin_, 0, 0};
    return value;
  }

  // A comment begins at a # behind a space, but not between quotes.
  void add(std::uint32_t number, const std::string& line) {
    char quote = 0;
    std::size_t end = line.size();
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      if (quote != 0)
        quote = c == quote ? 0 : quote;
      else if (c == '"' || c == '\'')
        quote = c;
      else if (c == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
        end = i;
        break;
      }
    }
    const std::size_t last = line.substr(0, end).find_last_not_of(" \t\r");
    if (last == std::string::npos) return;
    const std::size_t indent = line.find_first_not_of(' ');
    Line read{number, indent, line.substr(indent, last + 1 - indent)};
    if (read.text.front() == '\t') fail(read, "a tab indents it");
    if (quote != 0) fail(read, "a quote does not end");
    if (read.text == "---" && lines_.empty()) return;
    lines_.push_back(std::move(read));
  }

  scene::Value map(std::size_t indent) {
    scene::Value value = table(place(lines_[at_]));
    while (at_ < lines_.size() && lines_[at_].indent == indent) {
      const Line& line = lines_[at_];
      const std::size_t colon = line.text.find(':');
      if (line.text.front() == '-') fail(line, "a list stands here, not a key");
      if (colon == std::string::npos || (colon + 1 < line.text.size() && line.text[colon + 1] != ' '))
        fail(line, "there is no \"key: value\"");
      const std::string key = line.text.substr(0, colon);
      check_plain(line, key);
      if (value.find(key) != nullptr) fail(line, "the key stands there twice");
      const std::size_t begin = line.text.find_first_not_of(' ', colon + 1);
      ++at_;
      scene::Value item = begin != std::string::npos ? scalar(line, line.text.substr(begin)) : below(line);
      item.key_place = place(line);
      value.put(key, std::move(item));
    }
    if (at_ < lines_.size() && lines_[at_].indent > indent) fail(lines_[at_], "it is indented below a value");
    return value;
  }

  // Reads what stands below a key without a value.
  scene::Value below(const Line& key) {
    const bool deeper = at_ < lines_.size() && lines_[at_].indent > key.indent;
    const bool items =
        at_ < lines_.size() && lines_[at_].text.starts_with("-") && lines_[at_].indent >= key.indent;
    if (items) return list(lines_[at_].indent);
    return deeper ? map(lines_[at_].indent) : table(place(key));
  }

  scene::Value list(std::size_t indent) {
    scene::Value value = table(place(lines_[at_]));
    value.kind = Kind::array;
    for (; at_ < lines_.size() && lines_[at_].indent == indent && lines_[at_].text.starts_with("-"); ++at_) {
      const Line& line = lines_[at_];
      const std::size_t begin = line.text.find_first_not_of(' ', 1);
      if (begin == std::string::npos || begin == 1) fail(line, "a list has plain values here");
      const std::string item = line.text.substr(begin);
      if (item.find(": ") != std::string::npos || item.ends_with(":"))
        fail(line, "a list has plain values here");
      value.items.push_back(scalar(line, item));
    }
    return value;
  }

  void check_plain(const Line& line, const std::string& text) const {
    constexpr std::string_view kSpecial = "{}[]&*!|>%@`?,\"'";
    if (text.empty() || kSpecial.find(text.front()) != std::string_view::npos)
      fail(line, "it has a form that this reader does not know");
  }

  scene::Value scalar(const Line& line, const std::string& text) const {
    scene::Value value = table(place(line));
    value.kind = Kind::text;
    const char first = text.front();
    if (first == '"' || first == '\'') {
      if (text.size() < 2 || text.find(first, 1) != text.size() - 1 || text.find('\\') != std::string::npos)
        fail(line, "its quotes have a form that this reader does not know");
      value.text = text.substr(1, text.size() - 2);
      return value;
    }
    check_plain(line, text);
    value.text = text;
    const char* end = text.data() + text.size();
    if (const auto [at, error] = std::from_chars(text.data(), end, value.integer);
        error == std::errc{} && at == end) {
      value.kind = Kind::integer;
      value.real = static_cast<double>(value.integer);
    } else if (const auto [to, wrong] = std::from_chars(text.data(), end, value.real);
               wrong == std::errc{} && to == end) {
      value.kind = Kind::real;
    } else if (text == "true" || text == "false") {
      value.kind = Kind::boolean;
      value.boolean = text == "true";
    }
    return value;
  }

  std::shared_ptr<const scene::Origin> origin_;
  std::vector<Line> lines_;
  std::size_t at_ = 0;
};

}  // namespace

scene::Value parse_yaml_subset(const std::string& text, const std::shared_ptr<const scene::Origin>& origin) {
  return Parser(text, origin).document();
}

}  // namespace voxmelt::hwmodel
