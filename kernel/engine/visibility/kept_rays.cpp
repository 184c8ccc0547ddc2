#include "kernel/engine/visibility/kept_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "kernel/automaton/rule/ray.h"
#include "kernel/automaton/rule/source.h"
#include "kernel/automaton/rule/visibility.h"

namespace voxmelt::visibility {
namespace {

// A band has about so many cells. So more threads have work, and the memory of each is bounded.
constexpr int kBandCells = 1 << 15;
constexpr std::size_t kBatch = 1024;

bool same(const rule::Position& a, const rule::Position& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
// Tells if rays end at the same places.
bool same_ends(const rule::SourceKey& a, const rule::SourceKey& b) {
  return same(a.at, b.at) && a.radius == b.radius && same(a.direction, b.direction);
}

// Tells if a ray's fate is known. A ray that sees goes on to see. One that met a cell stays dark while that
// cell is opaque.
bool known(const Opaque& opaque, Fate fate) {
  return fate == kSees || fate == kNone || (fate != kDark && opaque.holds(fate));
}

}  // namespace

// Collects rays that are cast together, and the places of their fates.
class KeptRays::Batch {
 public:
  Batch(const Caster& caster, const Opaque& opaque, std::vector<Fate>& fates)
      : caster_(caster), opaque_(opaque), fates_(fates) {}

  void add(const Ray& ray, std::size_t place) {
    if (rays_.empty()) {  // most bands have few rays, or none
      rays_.reserve(kBatch);
      places_.reserve(kBatch);
    }
    rays_.push_back(ray);
    places_.push_back(place);
    if (rays_.size() == kBatch) cast();
  }
  void cast() {
    if (rays_.empty()) return;
    std::array<Fate, kBatch> found;
    caster_.cast(opaque_, rays_, {found.data(), rays_.size()});
    for (std::size_t i = 0; i < rays_.size(); ++i) fates_[places_[i]] = found[i];
    cast_ += rays_.size();
    rays_.clear();
    places_.clear();
  }
  std::int64_t count() const { return cast_; }

 private:
  const Caster& caster_;
  const Opaque& opaque_;
  std::vector<Fate>& fates_;
  std::vector<Ray> rays_;
  std::vector<std::size_t> places_;
  std::int64_t cast_ = 0;
};

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
  if (written_ != result.data()) result.clear();
  if (steady_ && !news_.any()) {
    for (Band& band : bands_) band.casts.cast = 0;
  } else {
    caster_->prepare(opaque_, news_);
    std::vector<Surface> surfaces;
    for (const Source& source : sources_) surfaces.emplace_back(volume.grid, source.kind, source.now);
    workers_.run(static_cast<int>(bands_.size()),
                 [&](int i) { update(volume, bands_[i], surfaces, result); });
    written_ = result.data();
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
    source.still =
        !news_.appeared && power > 0 && source.kind == heat.sources[s].kind && same_ends(source.now, now);
    source.steady = (source.still || now.power == 0) && power == now.power;
    source.kind = heat.sources[s].kind;
    source.now = now;
  }
}

void KeptRays::update(const state::Volume& volume, Band& band, const std::vector<Surface>& surfaces,
                      state::Field<std::uint16_t>& result) const {
  if (rests(band)) {
    band.casts.cast = 0;
    return;
  }
  erase(band, result);
  band.casts = {};
  std::size_t bytes = 0;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    renew(band, sources_[s], surfaces[s], band.sources[s]);
    bytes += band.sources[s].bytes();
  }
  band.cuts = write(volume, band, result);
  const state::Grid& g = opaque_.grid();
  const std::size_t rows = band.y1 - band.y0, cells = rows * g.x;
  band.kept = bytes <= kMostKept * cells + (std::size_t{16} << 10);
  if (!band.kept) band.sources.assign(sources_.size(), {});
}

void KeptRays::erase(const Band& band, state::Field<std::uint16_t>& result) const {
  if (!band.kept)
    for (int y = band.y0; y < band.y1; ++y)
      std::fill_n(result.row(y, band.z), opaque_.grid().x, std::uint16_t{0});
  for (const LitCells& own : band.sources)
    for (const Lit& lit : own.cells) {
      const Cell cell = cell_at(band, lit);
      result.row(cell[1], cell[2])[cell[0]] = 0;
    }
}

std::int64_t KeptRays::write(const state::Volume& volume, const Band& band,
                             state::Field<std::uint16_t>& result) const {
  std::int64_t cuts = 0;
  std::vector<state::Slot> partly;  // lit cells that are not full
  for (const LitCells& own : band.sources)
    for (const Lit& lit : own.cells) {
      if (lit.value == 0) continue;
      const Cell cell = cell_at(band, lit);
      const state::Slot at = volume.at(cell[0], cell[1], cell[2]);
      std::uint16_t& sum = result[at];
      if (sum == 0 && volume.amount[at] != rule::kOne) partly.push_back(at);
      const std::uint32_t whole = sum + lit.value;
      constexpr std::uint32_t most = rule::kIrradianceMax;
      sum = static_cast<std::uint16_t>(std::min(whole, most));
      if (whole > most) ++cuts;
    }
  for (const state::Slot at : partly) result[at] = rule::irradiance_of_amount(result[at], volume.amount[at]);
  return cuts;
}

// Tells if nothing here is new: no face, and no ray has lost the cell that it met. Then all is written
// already.
bool KeptRays::rests(const Band& band) const {
  if (!steady_ || !band.kept) return false;
  for (int w = band.y0 / 64; 64 * w < band.y1; ++w)
    if (rows_of(band, w, true) != 0) return false;
  return std::all_of(band.sources.begin(), band.sources.end(), [&](const LitCells& own) {
    return std::all_of(own.fates.begin(), own.fates.end(), [&](Fate fate) { return known(opaque_, fate); });
  });
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

void KeptRays::renew(Band& band, const Source& source, const Surface& surface, LitCells& own) const {
  if (source.now.power == 0) {
    own = {};
    return;
  }
  own = find(band, surface, own, source.still && band.kept);
  if (!source.steady)
    for (Lit& lit : own.cells) lit.value = kStale;
  band.casts += cast(band, source, own);
  const Fate* fates = own.fates.data();
  for (Lit& lit : own.cells) {
    if (lit.value == kStale) lit.value = value(band, source, lit, fates);
    fates += lit.rays;
  }
}

// Finds all cells with faces that look. If the source is still, known fates of their rays are taken over, and
// rows without a change are not looked at.
LitCells KeptRays::find(const Band& band, const Surface& surface, const LitCells& old, bool still) const {
  const LitCells none;
  RenewedLitCells now(still ? old : none, setting_.rays());
  const auto row_place = [&](std::uint32_t y) { return (y - band.y0) << 16; };
  const auto words = std::ssize(opaque_.plane().row(band.y0, band.z));
  const auto find_row = [&](int y) {
    for (int w = 0; w < words; ++w) {
      const Surface::Faces faces = surface.faces(opaque_, w, y, band.z);
      std::uint64_t any = 0;
      for (const std::uint64_t word : faces) any |= word;
      for (std::uint64_t bits = any; bits != 0; bits &= bits - 1) {
        const int b = std::countr_zero(bits);
        std::uint8_t looking = 0;
        for (std::size_t f = 0; f < faces.size(); ++f)
          looking = static_cast<std::uint8_t>(looking | (faces[f] >> b & 1) << f);
        now.look(row_place(y) | (64 * w + b), looking);
      }
    }
    now.drop_before(row_place(y + 1));
  };
  for (int w = band.y0 / 64; 64 * w < band.y1; ++w)
    for (std::uint64_t rows = rows_of(band, w, still); rows != 0; rows &= rows - 1) {
      const int y = 64 * w + std::countr_zero(rows);
      now.keep_before(row_place(y));
      find_row(y);
    }
  now.keep_before(row_place(band.y1));
  return now.take();
}

// Casts each ray unless it is known to see the source, or to meet a cell that is still opaque.
Casts KeptRays::cast(const Band& band, const Source& source, LitCells& own) const {
  Batch batch(*caster_, opaque_, own.fates);
  std::int64_t asked = 0;
  std::size_t place = 0;
  for (Lit& lit : own.cells) {
    const auto end = place + lit.rays;
    const auto is_known = [&](std::size_t at) { return known(opaque_, own.fates[at]); };
    const std::size_t first = place;
    while (place < end && is_known(place)) asked += own.fates[place++] != kNone;
    if (place == end) continue;  // most cells have nothing new
    const Cell cell = cell_at(band, lit);
    rule::CellRays rays(setting_, source.kind, source.now, cell);
    std::size_t at = first;
    for (int f = 0; f < rule::kFaces; ++f) {
      if ((lit.faces >> f & 1) == 0) continue;
      rays.choose(f);
      for (int i = 0; i < setting_.side; ++i)
        for (int j = 0; j < setting_.side; ++j, ++at) {
          if (at < place) continue;
          if (!is_known(at)) {
            const rule::Position start = rays.start(i, j);
            const rule::CellRays::Ray ray = rays.ray(setting_.side * i + j, start);
            own.fates[at] = ray.weight > 0 ? kDark : kNone;
            if (ray.weight > 0) batch.add({beyond_face(cell, rule::face_of(f)), start, ray.end}, at);
            lit.value = kStale;
          }
          asked += own.fates[at] != kNone;
        }
    }
    place = end;
  }
  batch.cast();
  return {asked, batch.count()};
}

std::uint32_t KeptRays::value(const Band& band, const Source& source, const Lit& lit,
                              const Fate* fates) const {
  rule::CellRays rays(setting_, source.kind, source.now, cell_at(band, lit));
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

Cell KeptRays::cell_at(const Band& band, const Lit& lit) {
  const int x = lit.place & 0xffff, row = lit.place >> 16;
  return {x, band.y0 + row, band.z};
}

std::size_t KeptRays::kept_bytes() const {
  std::size_t bytes = 0;
  for (const Band& band : bands_)
    for (const LitCells& own : band.sources) bytes += own.bytes();
  return bytes;
}

}  // namespace voxmelt::visibility
