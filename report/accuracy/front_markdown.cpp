// The file docs/results/front.md has the front in tables, for readers of the sources.
#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "report/accuracy/front.h"
#include "report/accuracy/front_text.h"
#include "report/accuracy/wrapped.h"

namespace voxmelt::accuracy {
namespace {

std::string markdown(const FrontTable& table) {
  std::string out = "|", rule = "|";
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    out += fmt::format(" {} |", table.head[i]);
    rule += i < table.texts ? "---|" : "---:|";
  }
  out += "\n" + rule + "\n";
  for (const auto& row : table.rows) {
    out += "|";
    for (const std::string& cell : row) out += fmt::format(" {} |", cell);
    out += "\n";
  }
  return out;
}

}  // namespace

std::string markdown_text(const FrontReport& report) {
  std::string out = fmt::format(
      "<!-- Written by `voxmelt accuracy --front`; accuracy/write_front.sh puts it here. -->\n"
      "# Speed against error\n\n{}\n\n"
      "Run it yourself: `voxmelt accuracy --front --out out/front` writes this and a page with pictures.\n\n"
      "## Which setting to take\n\n{}",
      wrapped(about_text(report)), markdown(picks_table(report)));
  for (const std::string& paragraph : texts_below_picks(report))
    out += fmt::format("\n{}\n", wrapped(paragraph));
  for (const front::Swept& swept : report.swept)
    out += fmt::format("\n## {}\n\n{}\n\n{}", title_of(swept), wrapped(noise_text(swept)),
                       markdown(points_table(swept)));
  if (const FrontTable formats = formats_table(report); !formats.rows.empty())
    out += fmt::format("\n## Number formats\n\n{}\n\n{}", wrapped(kFormatsText), markdown(formats));
  return out;
}

}  // namespace voxmelt::accuracy
