// The functions here read and write files of NumPy's format 1.0.
#include "npy.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace oracle {
namespace {

const std::string MAGIC("\x93NUMPY\x01\x00", 8);

std::string type_of(Int width) { return width == 1 ? "'|u1'" : "'<u2'"; }

// Returns "{'descr':'|u1','fortran_order':False,'shape':(2,3,4)", with `blank` after commas and colons.
std::string described(const std::array<Int, 3>& shape, Int width, const std::string& blank) {
  return "{'descr':" + blank + type_of(width) + "," + blank + "'fortran_order':" + blank + "False," + blank +
         "'shape':" + blank + "(" + std::to_string(shape[0]) + "," + blank + std::to_string(shape[1]) + "," +
         blank + std::to_string(shape[2]) + ")";
}

Int byte_at(const std::string& text, Int i) { return static_cast<unsigned char>(text[i]); }

}  // namespace

std::vector<Int> read_npy(const std::string& path, const std::array<Int, 3>& shape, Int width) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot open " + path);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.size() < 10 || text.compare(0, 8, MAGIC) != 0) throw std::runtime_error(path + ": not npy 1.0");
  const Int begin = 10 + byte_at(text, 8) + 256 * byte_at(text, 9);
  const Int count = shape[0] * shape[1] * shape[2];
  if (static_cast<Int>(text.size()) != begin + width * count) throw std::runtime_error(path + ": wrong size");

  std::string header;
  for (Int i = 10; i < begin; ++i)
    if (text[i] != ' ' && text[i] != '\n') header += text[i];
  const std::string wanted = described(shape, width, "");
  if (header != wanted + ",}" && header != wanted + "}")
    throw std::runtime_error(path + ": header " + header + ", expected " + wanted + "}");

  std::vector<Int> values(count);
  for (Int i = 0; i < count; ++i) {
    values[i] = byte_at(text, begin + width * i);
    if (width == 2) values[i] += 256 * byte_at(text, begin + 2 * i + 1);
  }
  return values;
}

void write_npy(const std::string& path, const std::array<Int, 3>& shape, Int width,
               const std::vector<Int>& values) {
  std::string header = described(shape, width, " ") + ", }";
  while ((10 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string text = MAGIC;
  text += static_cast<char>(header.size() % 256);
  text += static_cast<char>(header.size() / 256);
  text += header;
  for (const Int value : values) {
    text += static_cast<char>(value % 256);
    if (width == 2) text += static_cast<char>(value / 256);
  }
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace oracle
