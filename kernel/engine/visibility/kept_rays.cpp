#include "kernel/engine/visibility/kept_rays.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "kernel/automaton/rule/ray.h"
#include "kernel/automaton/rule/source.h"
#include "kernel/automaton/rule/visibility.h"
#include "kernel/engine/visibility/beam.h"
#include "kernel/engine/visibility/renewal.h"

namespace voxmelt::visibility {
namespace {

// A band has about so many cells. So more threads have work, and the memory of each is bounded.
constexpr int kBandCells = 1 << 15;

bool same(const rule::Position& a, const rule::Position& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
// Tells if rays end at the same places.
bool same_ends(const rule::SourceKey& a, const rule::SourceKey& b) {
  return same(a.at, b.at) && a.radius == b.radius && same(a.direction, b.direction);
}

void note(state::ChangedRows& changed, const Cell& cell) {
  const auto [x, y, z] = cell;
  if (changed.empty() || changed.back().y != y || changed.back().z != z) changed.push_back({y, z, 0});
  changed.back().words |= std::uint64_t{1} << (x / 64);
}

}  // namespace

std::int64_t KeptRays::irradiance(const state::Volume& volume, const rule::Heat& heat, std::uint32_t step,
                                  state::Field<std::uint16_t>& result) {
  const state::Grid before = opaque_.grid();
  news_ = opaque_.take(volume, workers_);
  const rule::RaySetting setting = rule::ray_setting({volume.grid.x, volume.grid.y, volume.grid.z}, heat);
  if (before != volume.grid || setting.side != setting_.side || heat.ray_seed != seed_ ||
      heat.sources.size() != sources_.size()) {
    setting_ = setting;
    seed_ = heat.ray_seed;
    written_ = nullptr;
    begin(heat);
  }
  move_sources(heat, step);
  steady_ = written_ == result.data() &&
            std::all_of(sources_.begin(), sources_.end(), [](const Source& s) { return s.steady; });
  tells_ = written_ == result.data();
  if (!tells_) result.clear();
  changed_.clear();
  if (steady_ && !news_.any()) {
    for (Band& band : bands_) band.casts.cast = 0;
  } else {
    caster_->prepare(opaque_, news_);
    std::vector<Surface> surfaces;
    for (const Source& source : sources_) surfaces.emplace_back(volume.grid, source.kind, source.now);
    workers_.run(static_cast<int>(bands_.size()),
                 [&](int i) { update(volume, bands_[i], surfaces, result); });
    written_ = result.data();
    for (const Band& band : bands_) changed_.insert(changed_.end(), band.changed.begin(), band.changed.end());
  }
  std::int64_t cuts = 0;
  for (const Band& band : bands_) {
    cuts += band.cuts;
    casts_ += band.casts;
  }
  return cuts;
}

void KeptRays::begin(const rule::Heat& heat) {
  const state::Grid& g = opaque_.grid();
  sources_.assign(heat.sources.size(), {});
  bands_.clear();
  const int rows = std::clamp(kBandCells / g.x, 1, g.y);
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; y += rows) {
      Band& band = bands_.emplace_back();
      band.z = z;
      band.y0 = y;
      band.y1 = std::min(g.y, y + rows);
      band.sources.resize(sources_.size());
    }
}

// Updates the sources. A source that has just been made has power 0, as one that is off. Nothing is kept of
// either.
void KeptRays::move_sources(const rule::Heat& heat, std::uint32_t step) {
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const rule::SourceKey now = rule::source_at(heat.sources[s], step);
    Source& source = sources_[s];
    const std::uint64_t power = source.now.power;
    source.still = power > 0 && source.kind == heat.sources[s].kind && same_ends(source.now, now);
    source.steady = (source.still || now.power == 0) && power == now.power;
    source.kind = heat.sources[s].kind;
    source.now = now;
  }
}

void KeptRays::update(const state::Volume& volume, Band& band, const std::vector<Surface>& surfaces,
                      state::Field<std::uint16_t>& result) const {
  band.changed.clear();
  band.casts = {};
  if (!band.kept) erase(band, result);
  Renewal found(*caster_, opaque_);
  for (std::size_t s = 0; s < sources_.size(); ++s) renew(band, s, surfaces[s], found);
  found.batch.cast();
  band.casts.cast = found.batch.count();
  for (const Renewal::Stale& stale : found.stale) {
    LitCells& own = band.sources[stale.source];
    Lit& lit = own.cells[stale.cell];
    lit.value = value(band, sources_[stale.source], lit, own.fates.data() + stale.fate);
    found.touched.push_back(lit.place);
  }
  // If there are cuts, all are counted anew.
  if (!steady_ || (band.cuts > 0 && !found.touched.empty())) {
    band.cuts = 0;
    for (const LitCells& own : band.sources) found.touch(own);
  }
  std::sort(found.touched.begin(), found.touched.end());
  found.touched.erase(std::unique(found.touched.begin(), found.touched.end()), found.touched.end());
  write(volume, band, found.touched, result);
  limit(band);
}

// Erases a band of which nothing is kept.
void KeptRays::erase(Band& band, state::Field<std::uint16_t>& result) const {
  const int words = static_cast<int>(state::words_for(opaque_.grid().x));
  for (int y = band.y0; y < band.y1; ++y) {
    std::fill_n(result.row(y, band.z), opaque_.grid().x, std::uint16_t{0});
    band.changed.push_back({y, band.z, ~std::uint64_t{0} >> (64 - words)});
  }
}

// Writes the irradiance of these places, which ascend, and adds their cuts.
void KeptRays::write(const state::Volume& volume, Band& band, const std::vector<std::uint32_t>& places,
                     state::Field<std::uint16_t>& result) const {
  std::vector<const Lit*> next;  // by source
  for (const LitCells& own : band.sources) next.push_back(own.cells.data());
  const auto before = [](const Lit& lit, std::uint32_t place) { return lit.place < place; };
  for (const std::uint32_t place : places) {
    std::uint32_t sum = 0;
    for (std::size_t s = 0; s < next.size(); ++s) {
      const std::vector<Lit>& cells = band.sources[s].cells;
      const Lit* const end = cells.data() + cells.size();
      next[s] = std::lower_bound(next[s], end, place, before);
      if (next[s] == end || next[s]->place != place) continue;
      sum += next[s]->value;
      constexpr std::uint32_t most = rule::kIrradianceMax;
      if (sum > most) ++band.cuts;
      sum = std::min(sum, most);
    }
    const Cell cell = cell_at(band, place);
    const state::Slot at = volume.at(cell[0], cell[1], cell[2]);
    if (sum > 0) sum = rule::irradiance_of_amount(sum, volume.amount[at]);
    if (result[at] == sum) continue;
    result[at] = static_cast<std::uint16_t>(sum);
    note(band.changed, cell);
  }
}

// Keeps nothing of a band that takes too much memory.
void KeptRays::limit(Band& band) const {
  std::size_t bytes = 0;
  for (const LitCells& own : band.sources) bytes += own.bytes();
  const std::size_t rows = band.y1 - band.y0, cells = rows * opaque_.grid().x;
  band.kept = bytes <= kMostKept * cells + (std::size_t{16} << 10);
  if (!band.kept) band.sources.assign(sources_.size(), {});
}

// Returns the rows of the band among y = 64 w to 64 w + 63. With `changed` it takes only those that may have
// other faces than before.
std::uint64_t KeptRays::rows_of(const Band& band, int w, bool changed) const {
  const auto below = [w](int y) {  // rows of this word before y
    const int rows = std::clamp(y - 64 * w, 0, 64);
    return rows == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rows) - 1;
  };
  const std::uint64_t rows = below(band.y1) & ~below(band.y0);
  return changed ? rows & opaque_.changed_about(w, band.z) : rows;
}

// Finds the cells with faces that look at a source, and the rays whose fate is not known.
void KeptRays::renew(Band& band, std::size_t s, const Surface& surface, Renewal& found) const {
  const Source& source = sources_[s];
  LitCells& own = band.sources[s];
  const bool dark = source.now.power == 0;
  if (dark || !source.still || !band.kept) {
    found.touch(own);
    own = {};
  }
  if (dark) return;
  if (news_.appeared) doubt(band, source, own);
  find(band, surface, source.still && band.kept, own, found);
  if (!source.steady)
    for (Lit& lit : own.cells) lit.value = kStale;
  cast(band, s, found);
}

// A ray that saw its source may no longer see it, where something appeared.
void KeptRays::doubt(const Band& band, const Source& source, LitCells& own) const {
  const Beam beam(source.kind, source.now, news_.box);
  Fate* fates = own.fates.data();
  for (const Lit& lit : own.cells) {
    if (beam.may_cross(cell_at(band, lit.place))) std::replace(fates, fates + lit.rays, kSees, kDark);
    fates += lit.rays;
  }
}

// Tells if a row of the band may have other faces than before.
bool KeptRays::has_new_faces(const Band& band) const {
  for (int w = band.y0 / 64; 64 * w < band.y1; ++w)
    if (rows_of(band, w, true) != 0) return true;
  return false;
}

// Finds all cells with faces that look. If the source is still, known fates of their rays are taken over, and
// only cells about a change are looked at.
void KeptRays::find(const Band& band, const Surface& surface, bool still, LitCells& own,
                    Renewal& found) const {
  if (still && !has_new_faces(band)) return;
  RenewedLitCells now(own, setting_.rays(), found.touched);
  const auto row_place = [&](std::uint32_t y) { return (y - band.y0) << 16; };
  const auto words = std::ssize(opaque_.plane().row(band.y0, band.z));
  const auto find_row = [&](int y) {
    for (int w = 0; w < words; ++w) {
      std::uint64_t cells = still ? opaque_.cells_about(w, y, band.z) : ~std::uint64_t{0};
      if (cells == 0) continue;
      const Surface::Faces faces = surface.faces(opaque_, w, y, band.z);
      if (!still) {
        cells = 0;
        for (const std::uint64_t word : faces) cells |= word;
      }
      for (std::uint64_t bits = cells; bits != 0; bits &= bits - 1) {
        const int b = std::countr_zero(bits);
        std::uint8_t looking = 0;
        for (std::size_t f = 0; f < faces.size(); ++f)
          looking = static_cast<std::uint8_t>(looking | (faces[f] >> b & 1) << f);
        now.look(row_place(y) | (64 * w + b), looking);
      }
    }
  };
  for (int w = band.y0 / 64; 64 * w < band.y1; ++w)
    for (std::uint64_t rows = rows_of(band, w, still); rows != 0; rows &= rows - 1) {
      const int y = 64 * w + std::countr_zero(rows);
      find_row(y);
    }
  own = now.take();
}

// Casts each ray unless it is known to see the source, or to meet a cell that is still opaque.
void KeptRays::cast(Band& band, std::size_t s, Renewal& found) const {
  const Source& source = sources_[s];
  LitCells& own = band.sources[s];
  const std::vector<std::uint32_t>& unknown = found.find_unknown(opaque_, own.fates);
  auto next = unknown.begin();
  const auto comes_before = [&](std::size_t end) { return next != unknown.end() && *next < end; };
  std::size_t at = 0;
  for (std::size_t n = 0; n < own.cells.size(); ++n) {
    const Lit& lit = own.cells[n];
    const std::size_t first = at, end = first + lit.rays;
    if (comes_before(end) || lit.value == kStale) found.stale.push_back({s, n, first});
    if (comes_before(end)) {
      const Cell cell = cell_at(band, lit.place);
      rule::CellRays rays(setting_, source.kind, source.now, cell);
      for (int f = 0; f < rule::kFaces; ++f) {
        if ((lit.faces >> f & 1) == 0) continue;
        rays.choose(f);
        for (; comes_before(at + setting_.rays()); ++next) {
          const int ray_number = static_cast<int>(*next - at);
          const rule::Position start = rays.start(ray_number / setting_.side, ray_number % setting_.side);
          const rule::CellRays::Ray ray = rays.ray(ray_number, start);
          Fate& fate = own.fates[*next];
          fate = ray.weight > 0 ? kDark : kNone;
          if (ray.weight > 0) found.batch.add({beyond_face(cell, rule::face_of(f)), start, ray.end}, fate);
        }
        at += setting_.rays();
      }
    }
    at = end;
  }
  band.casts.asked += std::ssize(own.fates) - std::count(own.fates.begin(), own.fates.end(), kNone);
}

std::uint32_t KeptRays::value(const Band& band, const Source& source, const Lit& lit,
                              const Fate* fates) const {
  rule::CellRays rays(setting_, source.kind, source.now, cell_at(band, lit.place));
  std::int64_t sum = 0;
  for (int f = 0; f < rule::kFaces; ++f) {
    if ((lit.faces >> f & 1) == 0) continue;
    rays.choose(f);
    for (int i = 0; i < setting_.side; ++i)
      for (int j = 0; j < setting_.side; ++j)
        if (*fates++ == kSees) sum += rays.ray(setting_.side * i + j, rays.start(i, j)).weight;
  }
  constexpr std::uint64_t cut = rule::kIrradianceMax + 1;
  return static_cast<std::uint32_t>(std::min(rays.receives(sum), cut));
}

Cell KeptRays::cell_at(const Band& band, std::uint32_t place) {
  const int x = place & 0xffff, row = place >> 16;
  return {x, band.y0 + row, band.z};
}

std::size_t KeptRays::kept_bytes() const {
  std::size_t bytes = 0;
  for (const Band& band : bands_)
    for (const LitCells& own : band.sources) bytes += own.bytes();
  return bytes;
}

}  // namespace voxmelt::visibility
