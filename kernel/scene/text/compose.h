// From files and options to one document: `extends` and --set.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Reads `file`; a top-level `extends = "other.toml"` is read first, then this file's keys replace its keys
// (tables are merged, anything else is replaced; a file that names flow.law drops the inherited table of the
// other law). Throws InputError.
Value read_document(const std::filesystem::path& file);

// Applies "path.to.key=value" (array elements by number: heat_source.0.power=3). Throws InputError naming
// --set.
void apply_override(Value& document, const std::string& assignment);

}  // namespace voxmelt::scene
