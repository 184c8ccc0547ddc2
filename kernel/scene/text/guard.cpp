#include "kernel/scene/text/guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace voxmelt::scene {
namespace {

// Walks through a document as TOML cuts it: comments, four kinds of strings, and everything else.
class Guard {
 public:
  explicit Guard(std::string_view document) : text_(document) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;  // a byte order mark
  }

  Objection run() {
    while (at_ < text_.size() && found_.text.empty()) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = end_of_line();
      } else if (c == '"' || c == '\'') {
        if (within_word_) {  // the parser would not take it for a string
          object(fmt::format("{} within a word", c));
          break;
        }
        skip_string(c);
        fresh_ = false;
        within_word_ = true;
      } else {
        look_at(c);
        ++at_;
        within_word_ =
            c == '.' ? in_value_ : std::string_view(" \t\r\n=,[]{}").find(c) == std::string_view::npos;
      }
    }
    return found_;
  }

 private:
  void look_at(char c) {
    const unsigned char byte = c;
    if (c == '\n') {
      dots_ = 0;
      ++line_;
      line_begin_ = at_ + 1;
      fresh_ = true;
      if (brackets_.empty()) in_value_ = false;
      return;
    }
    if (byte >= 0x80) return object("a letter outside ASCII must stand in quotes or in a comment");
    if ((byte < 0x20 && c != '\t' && c != '\r') || byte == 0x7f)
      return object(fmt::format("the control character 0x{:02x}", byte));
    if (c == '[' && fresh_ && brackets_.empty()) return check_header();
    if (c == '[' || c == '{') {
      dots_ = 0;
      brackets_ += c;
      in_value_ = c == '[';
      if (brackets_.size() > kDeepestBracket)
        object(fmt::format("more than {} brackets deep", kDeepestBracket));
    } else if (c == ']' || c == '}') {
      if (!brackets_.empty()) brackets_.pop_back();
      in_value_ = true;
    } else if (c == '=' || c == ',') {
      dots_ = 0;
      in_value_ = c == '=' || brackets_.ends_with('[');
    } else if (c == '.' && ++dots_ >= kDeepestKey) {
      object(fmt::format("a key of more than {} parts", kDeepestKey));
    }
    if (c != ' ' && c != '\t' && c != '\r') fresh_ = false;
  }

  // Checks that the name in a header stands on its line, whole.
  void check_header() {
    fresh_ = false;
    const std::string_view rest = text_.substr(at_, end_of_line() - at_);
    const std::size_t name = rest.find_first_not_of("[ \t\r");
    if (name == std::string_view::npos || rest[name] == '#') object("a table's name is missing");
  }

  // Skips a string. If it is not closed, it ends with its line, or with the document, and the parser reports
  // it.
  void skip_string(char quote) {
    const bool escapes = quote == '"';
    const bool many = text_.substr(at_, 3) == std::string_view(escapes ? "\"\"\"" : "'''");
    at_ += many ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') {
        if (!many) return;
        ++line_;
        line_begin_ = at_ + 1;
      } else if (c == '\\' && escapes) {
        if (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      } else if (c == quote && (!many || text_.substr(at_, 3) == std::string(3, quote))) {
        at_ += many ? 3 : 1;
        while (many && at_ < text_.size() && text_[at_] == quote) ++at_;  // quotes at its end belong to it
        return;
      }
    }
  }

  std::size_t end_of_line() const { return std::min(text_.find('\n', at_), text_.size()); }
  void object(std::string text) { found_ = {std::move(text), line_, at_ - line_begin_ + 1}; }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1, line_begin_ = 0;
  std::size_t dots_ = 0;
  std::string brackets_;      // brackets that are open
  bool fresh_ = true;         // nothing but blanks on this line yet
  bool in_value_ = false;     // if not, in a key or between lines
  bool within_word_ = false;  // the character before belongs to a bare word or a string
  Objection found_;
};

}  // namespace

Objection object_to(std::string_view document) { return Guard(document).run(); }

}  // namespace voxmelt::scene
