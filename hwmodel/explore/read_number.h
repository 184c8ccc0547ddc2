// Numbers with ranges are read from the tables of a device or a family.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "hwmodel/explore/ranged.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel::explore {

// Paths of keys that --set gives, without the name of the document: "stage.melt.lut". A number among them is
// taken as known, if its range is not among them.
using Given = std::set<std::string>;

inline constexpr std::int64_t kMostUnits = 100'000'000;

// Returns the text of `key`, or `missing`. Throws scene::InputError if it does not begin with the name of a
// source.
std::string read_source(scene::Reader& from, const std::string& key,
                        const std::optional<std::string>& missing = {});

// Each reads a number, its range and its source, which stand at keys that begin with `name`. A range must
// hold the number. If the file has none, it follows from the source. Without a source of its own, the number
// has the one that is given here.
Ranged<std::int64_t> read_logic(scene::Reader& from, const std::string& name, const std::string& source,
                                const Given& given);
Ranged<double> read_of_device(scene::Reader& from, const std::string& name, double lowest, double highest,
                              const Given& given);

}  // namespace voxmelt::hwmodel::explore
