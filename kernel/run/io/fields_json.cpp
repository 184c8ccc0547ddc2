#include <string>

#include "kernel/automaton/state/fields.h"
#include "kernel/run/io/export.h"

namespace voxmelt::io {

std::string fields_json(const state::Volume& volume) {
  std::string rows;
  state::for_each_field([&](const auto& row) {
    if ((volume.*row.column).empty()) return;
    rows += std::string(rows.empty() ? "" : ",\n") + "    {\"name\": \"" + std::string(row.name) +
            "\", \"bits\": " + std::to_string(row.bits);
    if (!row.unit.empty()) rows += ", \"unit\": \"" + std::string(row.unit) + "\"";
    rows += '}';
  });
  return "{\n  \"axes\": \"an npy array is indexed [z][y][x]; y points up, and a cell has the side 1\",\n"
         "  \"fields\": [\n" +
         rows + "\n  ]\n}\n";
}

}  // namespace voxmelt::io
