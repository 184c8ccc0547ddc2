// A document is printed as TOML text, which parse_text() reads as the same values.
#pragma once

#include <string>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Returns a text as a basic string, in its quotes.
std::string toml_string(const std::string& text);

// Prints keys, then tables, in the document's order. The document holds no dates, since no key of a scene is
// one.
std::string print_document(const Value& document);

}  // namespace voxmelt::scene
