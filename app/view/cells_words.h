// A page says which false colours it wants, and where the volume is cut open. It is told what the colours
// mean.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "voxmelt/cells.h"

namespace voxmelt::view {

// Reads "none", or a name of colours and maybe a cut: "phase", "sleep y 12". Throws InputError for others.
std::optional<CellView> read_cells(std::string_view text);

nlohmann::ordered_json json_of(const CellView& view);

}  // namespace voxmelt::view
