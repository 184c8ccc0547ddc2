#include "report/svg/svg.h"

#include <fmt/format.h>

#include "report/svg/style.h"

namespace voxmelt::page {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&'   ? "&amp;"
           : c == '<' ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

std::string text(double x, double y, const char* anchor, const std::string& what, const char* css) {
  return fmt::format(R"(<text class="{}" x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", css, x, y,
                     anchor, escaped(what));
}
std::string line(double x1, double y1, double x2, double y2, const char* css) {
  return fmt::format(R"(<line class="{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)", css, x1, y1, x2,
                     y2);
}

std::string document(const std::string& title, const std::string& style, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>voxmelt: {}</title>\n<style>{}{}</style></head>\n<body><main>\n{}</main></body></html>\n",
      escaped(title), kStyle, style, body);
}

}  // namespace voxmelt::page
