// The lit cells of some rows have faces that look at a source, and known fates of their rays. Such a list is
// renewed by copying each unchanged stretch in one piece.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/ray.h"
#include "kernel/engine/visibility/caster.h"

namespace voxmelt::visibility {

// Describes a cell with faces that look at the source.
struct Lit {
  std::uint32_t place;  // ascending; its meaning is up to the owner of the list
  std::uint32_t value;  // the cell's irradiance, or kStale
  std::uint8_t faces;   // a bit for each face
  std::uint8_t rays;    // number of rays of all its faces
};
inline constexpr std::uint32_t kStale = 0xffff'ffff;

struct LitCells {
  std::vector<Lit> cells;   // by place
  std::vector<Fate> fates;  // fates of the rays, by cell and by face
  std::size_t bytes() const { return cells.size() * sizeof(Lit) + fates.size() * sizeof(Fate); }
};

// Makes a list from an older one. Its calls go by ascending places. The places that look no more are added to
// `dropped`.
class RenewedLitCells {
 public:
  RenewedLitCells(const LitCells& old, int rays_per_face, std::vector<std::uint32_t>& dropped)
      : old_(old), each_(rays_per_face), dropped_(dropped) {
    now_.cells.reserve(old.cells.size() + kMore);
    now_.fates.reserve(old.fates.size() + kMore);
  }

  // Looks at a cell. It has these faces now, and all cells between it and the last one are as before. Known
  // fates of a face are kept.
  void look(std::uint32_t place, std::uint8_t faces) {
    while (more() && next().place < place) pass();
    const bool was = more() && next().place == place;
    if (was && next().faces == faces) return pass();
    if (!was && faces == 0) return;
    copy();
    if (faces == 0) {
      dropped_.push_back(place);
      pass();
      return begin();
    }
    now_.cells.push_back({place, kStale, faces, static_cast<std::uint8_t>(each_ * std::popcount(faces))});
    std::size_t from = fate_;
    for (int f = 0; f < rule::kFaces; ++f) {
      const bool looked = was && (next().faces >> f & 1) != 0, looks = (faces >> f & 1) != 0;
      for (int n = 0; looks && n < each_; ++n) now_.fates.push_back(looked ? old_.fates[from + n] : kDark);
      from += (looked ? each_ : 0);
    }
    if (was) pass();
    begin();
  }

  // Returns the list. All other cells are as before.
  LitCells take() {
    while (more()) pass();
    copy();
    return std::move(now_);
  }

 private:
  static constexpr std::size_t kMore = 64;  // about as many come at once

  bool more() const { return cell_ < old_.cells.size(); }
  const Lit& next() const { return old_.cells[cell_]; }
  void pass() { fate_ += old_.cells[cell_++].rays; }
  void begin() {
    first_cell_ = cell_;
    first_fate_ = fate_;
  }
  // Copies the cells that were passed since `begin`.
  void copy() {
    const auto append = [](auto& to, const auto& from, std::size_t first, std::size_t end) {
      const auto begin = from.begin();
      to.insert(to.end(), begin + static_cast<std::ptrdiff_t>(first),
                begin + static_cast<std::ptrdiff_t>(end));
    };
    append(now_.cells, old_.cells, first_cell_, cell_);
    append(now_.fates, old_.fates, first_fate_, fate_);
    begin();
  }

  const LitCells& old_;
  int each_;
  std::vector<std::uint32_t>& dropped_;
  LitCells now_;
  std::size_t cell_ = 0, fate_ = 0;              // next of the old ones
  std::size_t first_cell_ = 0, first_fate_ = 0;  // first one that is not copied yet
};

}  // namespace voxmelt::visibility
