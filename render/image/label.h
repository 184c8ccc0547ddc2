// Short captions are drawn in a tiny built-in font. It has A-Z (small letters are drawn as capitals), 0-9 and
// . : - / % = +.
#pragma once

#include <string_view>

#include "render/image/image.h"

namespace voxmelt::render {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7;

// Returns the width of a caption in pixels, with glyphs one column apart.
int label_width(std::string_view text, int scale);

// Draws a caption with its upper left corner at (x, y). Pixels outside the picture are left out. Other
// characters are drawn as blanks.
void draw_label(Image& image, std::string_view text, int x, int y, int scale, Rgb color);

}  // namespace voxmelt::render
