// This provider casts only rays that may have changed. While a source stands still, a ray that saw it sees
// it, unless an opaque cell has appeared about its way: then it is cast anew. A dark ray stays dark while the
// cell that it met is opaque. If a source moves, every ray is cast anew. A sky always stands still. So the
// irradiance is the same as if all rays were cast each time, and depends on no memory.
//
// While all sources are steady, only cells about a change of the masks are looked at, and only cells with a
// new fate or face are written. The fates alone are gone through in every call that finds news.
//
// Beside Opaque, it keeps 12 bytes for each cell with a face that looks, and 4 for each of its rays. A band
// of rows keeps at most kMostKept bytes for each of its cells and 16 KiB. Beyond that it keeps nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/engine/visibility/caster.h"
#include "kernel/engine/visibility/lit_cells.h"
#include "kernel/engine/visibility/opaque.h"
#include "kernel/engine/visibility/surface.h"
#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::visibility {

struct Renewal;

class KeptRays final : public Provider {
 public:
  static constexpr std::size_t kMostKept = 4;

  explicit KeptRays(std::unique_ptr<Caster> caster = std::make_unique<TwoLevelCaster>(), int threads = 1)
      : caster_(std::move(caster)), workers_(threads) {}

  std::int64_t irradiance(const state::Volume& volume, const rule::Heat& heat, std::uint32_t step,
                          state::Field<std::uint16_t>& result) override;
  void forget_amounts() override { written_ = nullptr; }
  const state::ChangedRows* changed() const override { return tells_ ? &changed_ : nullptr; }
  std::string_view name() const override { return caster_->name(); }
  Casts casts() const override { return casts_; }
  std::size_t kept_bytes() const;  // beside Opaque

 private:
  // Is the work of one thread: some rows of a slice.
  struct Band {
    int z = 0, y0 = 0, y1 = 0;
    // A cell's place is its row within the band times 2^16, and x. Its value is cut just above the largest.
    std::vector<LitCells> sources;
    bool kept = true;  // if not, its cells of the sources took too much memory
    std::int64_t cuts = 0;
    Casts casts;
    state::ChangedRows changed;  // rows that were written
  };
  struct Source {
    rule::SourceKind kind = rule::SourceKind::point;
    rule::SourceKey now;
    bool still = false;   // its rays end at the same places as before
    bool steady = false;  // moreover, its power is the same as before
  };

  void begin(const rule::Heat& heat);
  void move_sources(const rule::Heat& heat, std::uint32_t step);
  void update(const state::Volume& volume, Band& band, const std::vector<Surface>& surfaces,
              state::Field<std::uint16_t>& result) const;
  void renew(Band& band, std::size_t source, const Surface& surface, Renewal& found) const;
  void doubt(const Band& band, const Source& source, LitCells& own) const;
  bool has_new_faces(const Band& band) const;
  std::uint64_t rows_of(const Band& band, int w, bool changed) const;
  void find(const Band& band, const Surface& surface, bool still, LitCells& own, Renewal& found) const;
  void cast(Band& band, std::size_t source, Renewal& found) const;
  std::uint32_t value(const Band& band, const Source& source, const Lit& lit, const Fate* fates) const;
  void erase(Band& band, state::Field<std::uint16_t>& result) const;
  void write(const state::Volume& volume, Band& band, const std::vector<std::uint32_t>& places,
             state::Field<std::uint16_t>& result) const;
  void limit(Band& band) const;
  static Cell cell_at(const Band& band, std::uint32_t place);

  std::unique_ptr<Caster> caster_;
  cpu::Workers workers_;
  Opaque opaque_;
  Opaque::News news_;
  rule::RaySetting setting_{};
  std::uint64_t seed_ = 0;
  std::vector<Source> sources_;
  std::vector<Band> bands_;
  const void* written_ = nullptr;  // address of the last result
  bool steady_ = false;            // the same result is given again, and all sources are steady
  bool tells_ = false;             // changed_ has all that the last call changed
  state::ChangedRows changed_;
  Casts casts_;
};

}  // namespace voxmelt::visibility
