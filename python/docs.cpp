#include "python/docs.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace voxmelt::python {
namespace {

struct Comment {
  std::string_view name;
  const char* text;
};

constexpr Comment kComments[] = {
#include <header_docs.inc>
};

}  // namespace

const char* doc(std::string_view name) {
  const auto* const found = std::ranges::find(kComments, name, &Comment::name);
  if (found == std::end(kComments)) throw std::logic_error("no comment on " + std::string(name));
  return found->text;
}

}  // namespace voxmelt::python
