// With --picture FILE, picture_judge draws the picture. With --field FILE it writes filtered channels and
// drawn heights. With --surface FILE it writes five numbers of 8 bytes for each pixel: what it shows, where,
// and how deep.
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>
#include "picture.h"

static void put_bytes(Int value, int count) {
  for (int i = 0; i < count; ++i) std::cout.put(static_cast<char>((value >> (8 * i)) & 255));
}

int main(int count, char** words) {
  try {
    const std::string wish = count == 3 ? words[1] : "";
    if (wish != "--picture" && wish != "--field" && wish != "--surface")
      throw std::runtime_error("usage: picture_judge --picture FILE, --field FILE, or --surface FILE");
    const Input in = read_input(words[2]);
    if (wish == "--field") {
      const std::vector<Column> columns = make_columns(in);
      const Field field = make_field(in, columns);
      const Ground ground(in, columns);
      for (const Ints* channel :
           {&field.intensity, &field.solid, &field.liquid, &field.heat, &field.obstacle})
        for (const Int value : *channel) put_bytes(value, 2);
      for (const Int height : ground.drawn) put_bytes(height, 4);
    } else {
      if (in.setting != "fast" && in.setting != "normal" && in.setting != "best")
        throw std::runtime_error("unknown setting");
      const Scene scene(in);
      if (wish == "--surface")
        for (Int j = 0; j < in.height; ++j)
          for (Int i = 0; i < in.width; ++i) {
            const Met met = met_by(scene, i, j, m_of(scene));
            for (const Int number : {met.kind, met.position.x, met.position.y, met.position.z, met.z})
              put_bytes(number, 8);
          }
      else
        for (const Vec& pixel : draw_picture(scene))
          for (int channel = 0; channel < 3; ++channel) put_bytes(pixel.at(channel), 1);
    }
    return std::cout.flush() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "picture_judge: " << error.what() << "\n";
    return 1;
  }
}
