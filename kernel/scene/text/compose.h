// Files and options become one document, by `extends` and --set.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Reads `file`. A top-level `extends = "other.toml"` is read first, then this file's keys replace its keys.
// Tables are merged, and anything else is replaced. A file that names flow.law drops the inherited table of
// the other law. It throws InputError.
Value read_document(const std::filesystem::path& file);

// Applies "path.to.key=value" (array elements by number: heat_source.0.power=3). It throws InputError with
// the name of --set.
void apply_override(Value& document, const std::string& assignment);

}  // namespace voxmelt::scene
