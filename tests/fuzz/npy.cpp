// The target reads a field of [start], beside five good ones. The first byte says which.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/target.h"

namespace {

struct Field {
  const char* name;
  int bytes;
};
constexpr std::array<Field, 6> kFields{
    {{"solid", 1}, {"liquid", 1}, {"inert", 1}, {"amount", 2}, {"energy", 2}, {"heat", 2}}};

// Makes zeros in the shape (2, 3, 4).
std::string zeros(int bytes) {
  std::string header = "{'descr': '" + std::string(bytes == 1 ? "|u1" : "<u2") +
                       "', 'fortran_order': False, 'shape': (2, 3, 4), }";
  header.resize(117, ' ');
  header += '\n';
  std::string text("\x93NUMPY\x01\x00", 8);
  text += static_cast<char>(header.size() & 255);
  text += static_cast<char>(header.size() >> 8);
  return text + header + std::string(static_cast<std::size_t>(24 * bytes), '\0');
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  if (size == 0) return 0;
  static const auto scene = fuzz::write("scene.toml",
                                        "[grid]\nsize = [4, 3, 2]\n[start]\nfields = \"fields\"\n"
                                        "[heat]\ngamma = 0.1\n[flow]\nlaw = \"paper\"\n");
  const Field& field = kFields[data[0] % kFields.size()];
  for (const Field& one : kFields)
    fuzz::write(std::string("fields/") + one.name + ".npy",
                one.name == field.name ? fuzz::text_of(data + 1, size - 1) : zeros(one.bytes));
  fuzz::try_to([&] { scene::load(scene, {}); });
  return 0;
}
