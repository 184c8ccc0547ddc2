// Short captions in a tiny built-in font: A-Z (small letters are drawn as capitals), 0-9 and . : - / % = +.
#pragma once

#include <string_view>

#include "render/image/image.h"

namespace voxmelt::render {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7;

// Size of a caption in pixels, glyphs one column apart.
int label_width(std::string_view text, int scale);

// The caption's upper left corner is (x, y); what falls outside the picture is left out. Other characters
// are drawn as blanks.
void draw_label(Image& image, std::string_view text, int x, int y, int scale, Rgb color);

}  // namespace voxmelt::render
