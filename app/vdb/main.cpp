// The program voxmelt-vdb reads and writes files of OpenVDB for voxmelt. kernel/vdb/stream.h says what it is
// given and gives. A file can be hostile, so time and memory are bounded before it is opened.
#include <openvdb/openvdb.h>
#include <signal.h>
#include <sys/prctl.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <ios>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "app/vdb/archives.h"
#include "app/vdb/bounds.h"
#include "app/vdb/write.h"
#include "kernel/vdb/stream.h"

namespace voxmelt::vdb {
namespace {

constexpr int kMostVoxels = 4096;                             // along a side
constexpr std::uint64_t kMostInAll = std::uint64_t{1} << 30;  // voxels
constexpr std::uint64_t kRoom = std::uint64_t{128} << 20;     // bytes of memory, whatever the file
constexpr std::uint64_t kTimes = 48;  // as many for a byte of the file: a packed inner node has some 40
constexpr std::uint64_t kBytesPerSecond = 8 << 20;
constexpr rlim_t kMostSeconds = 3600;

struct Wanted {
  std::string grid;
  bool is_default = true;  // inside of a level set, or at least half of a fog
  double low = 0.5, high = 1e15;
};

// Returns the sides of a voxel, negative where the grid is mirrored.
openvdb::Vec3d sides_of(const openvdb::GridBase& grid) {
  const auto fail = [] {
    throw std::runtime_error("its voxels are turned, or no boxes; resample it to a grid along the axes");
  };
  if (!grid.transform().isLinear()) fail();
  const openvdb::Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
  openvdb::Vec3d sides;
  for (int i = 0; i < 3; ++i) sides[i] = matrix(i, i);
  const double least = std::min({std::abs(sides[0]), std::abs(sides[1]), std::abs(sides[2])});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && !(std::abs(matrix(i, j)) <= 1e-6 * least)) fail();
  return sides;
}

template <class Grid>
void give_voxels(const Grid& grid, const Wanted& wanted, const std::string& others) {
  const openvdb::Vec3d sides = sides_of(grid);
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) throw std::runtime_error("the grid '" + plain(grid.getName()) + "' has no active voxel");
  std::array<std::int64_t, 3> size{};
  std::uint64_t voxels = 1;
  for (int i = 0; i < 3; ++i) {
    size[i] = std::int64_t{box.max()[i]} - box.min()[i] + 1;
    if (size[i] > kMostVoxels)
      throw std::runtime_error("a side of " + std::to_string(size[i]) + " voxels; 1 to " +
                               std::to_string(kMostVoxels) + " are read");
    voxels *= static_cast<std::uint64_t>(size[i]);
  }
  if (voxels > kMostInAll)
    throw std::runtime_error(std::to_string(voxels) + " voxels; at most " + std::to_string(kMostInAll) +
                             " are read");
  std::array<char, 256> head{};
  std::snprintf(head.data(), head.size(), "ok %d %d %d %.17g %.17g %.17g\n", static_cast<int>(size[0]),
                static_cast<int>(size[1]), static_cast<int>(size[2]), std::abs(sides[0]), std::abs(sides[1]),
                std::abs(sides[2]));
  give(head.data() + plain(grid.getName()) + "\n" + others + "\n");

  const bool is_inside = wanted.is_default && grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  const double low = is_inside ? -1e15 : wanted.low, high = is_inside ? 0 : wanted.high;
  const auto place = [&](std::int64_t at, int axis) {  // from below, also where the grid is mirrored
    return static_cast<int>(sides[axis] < 0 ? box.max()[axis] - at : box.min()[axis] + at);
  };
  const auto values = grid.getConstAccessor();
  std::string row(static_cast<std::size_t>(size[0]), '\0');
  for (std::int64_t z = 0; z < size[2]; ++z)
    for (std::int64_t y = 0; y < size[1]; ++y) {
      for (std::int64_t x = 0; x < size[0];) {
        const openvdb::Coord at(place(x, 0), place(y, 1), place(z, 2));
        const auto value = static_cast<double>(values.getValue(at));
        // Without a leaf all voxels up to the next brick are alike.
        const int in_brick = at[0] & (kSide - 1);
        const int alike = values.probeConstLeaf(at) != nullptr ? 1
                          : sides[0] < 0                       ? in_brick + 1
                                                               : kSide - in_brick;
        const std::int64_t end = std::min(size[0], x + alike);
        std::fill(row.begin() + x, row.begin() + end, low <= value && value <= high ? 1 : 0);
        x = end;
      }
      give(row);
    }
}

void read(const std::string& place, const Wanted& wanted) {
  using Numbers = openvdb::NumericGridTypes::Append<openvdb::BoolGrid, openvdb::MaskGrid>;
  const std::uint64_t bytes = std::filesystem::file_size(place);
  bound(RLIMIT_AS, room_in_use() + kRoom + kTimes * bytes);
  bound(RLIMIT_CORE, 0);
  bound(RLIMIT_CPU, 1 + bytes / kBytesPerSecond);
  std::vector<std::string> names;
  const openvdb::GridBase::Ptr grid = Source(place).find(wanted.grid, names);
  bound(RLIMIT_CPU, kMostSeconds);  // what follows takes as long as the grid is large
  std::string listed;
  for (const std::string& name : names) listed += (listed.empty() ? "'" : ", '") + plain(name) + "'";
  if (names.empty()) throw std::runtime_error("it has no grids");
  if (!grid) throw std::runtime_error("it has no grid '" + plain(wanted.grid) + "'; its grids are " + listed);
  const std::string others = wanted.grid.empty() && names.size() > 1 ? listed : "";
  const auto give_it = [&](const auto& typed) { give_voxels(typed, wanted, others); };
  if (!grid->apply<Numbers>(give_it))
    throw std::runtime_error("the grid '" + plain(grid->getName()) + "' has values of the type " +
                             plain(grid->valueType()) + ", not numbers; its grids are " + listed);
}

template <class Number>
Number number_in(const std::string& word) {
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || *end != 0) throw std::runtime_error(plain(word) + " is no number");
  return number;
}

int run(const std::vector<std::string>& words) {
  const std::string usage = "voxmelt calls it: `voxmelt export --format vdb`";
  if (words.size() < 2) throw std::runtime_error(usage);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  openvdb::initialize();
  if (words[1] == "write" && words.size() == 5) {
    Writer(words[2], number_in<std::int32_t>(words[3]), number_in<std::int32_t>(words[4])).write();
    give("ok\n");
  } else if (words[1] == "read" && words.size() == 6) {
    Wanted wanted{words[3]};
    wanted.is_default = words[4].empty();
    if (!wanted.is_default) {
      wanted.low = number_in<double>(words[4]);
      wanted.high = number_in<double>(words[5]);
    }
    read(words[2], wanted);
  } else {
    throw std::runtime_error(usage);
  }
  return std::fflush(output()) == 0 ? 0 : 3;
}

}  // namespace
}  // namespace voxmelt::vdb

int main(int argc, char** argv) {
  using namespace voxmelt::vdb;
  const pid_t caller = ::getppid();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != caller) return 3;  // it has died meanwhile
  output();                             // from now on, what OpenVDB has to say goes elsewhere
  try {
    return run({argv, argv + argc});
  } catch (const std::ios_base::failure&) {
    const int why = errno;
    const bool is_full = why == ENOSPC || why == EDQUOT || why == EFBIG;
    const bool is_read = argc > 1 && argv[1] == std::string("read");
    give(is_read ? "error it ends too early: is it truncated?\n"
                 : (is_full ? "full " : "error ") + std::string(std::strerror(why)) + "\n");
  } catch (const std::bad_alloc&) {
    give("error OpenVDB wants more memory than a file of this size should take\n");
  } catch (const std::exception& error) {
    give("error " + plain(error.what()) + "\n");
  }
  std::fflush(output());
  return 0;
}
