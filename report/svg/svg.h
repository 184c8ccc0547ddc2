// Every page and picture of the program is made of escaped text, marks at places, and the frame of a page.
#pragma once

#include <string>

namespace voxmelt::page {

std::string escaped(const std::string& text);  // escapes &, <, > and "

// Makes a text of SVG; `anchor` is start, middle or end.
std::string text(double x, double y, const char* anchor, const std::string& what, const char* css = "tick");
std::string line(double x1, double y1, double x2, double y2, const char* css);

// Makes a whole HTML file. `style` follows the style sheet that all pages share.
std::string document(const std::string& title, const std::string& style, const std::string& body);

}  // namespace voxmelt::page
