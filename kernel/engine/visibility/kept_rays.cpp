#include "kernel/engine/visibility/kept_rays.h"

#include <algorithm>
#include <array>
#include <bit>

#include "kernel/automaton/rule/ray.h"
#include "kernel/automaton/rule/source.h"
#include "kernel/automaton/rule/visibility.h"

namespace voxmelt::visibility {
namespace {

constexpr int kBandCells = 1 << 15;  // about; more threads have work, and the memory of each is bounded
constexpr std::uint32_t kStale = 0xffff'ffff;
constexpr std::size_t kBatch = 1024;

bool same(const rule::Position& a, const rule::Position& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
// Do rays end at the same places?
bool same_ends(const rule::SourceKey& a, const rule::SourceKey& b) {
  return same(a.at, b.at) && a.radius == b.radius && same(a.direction, b.direction);
}

// Rays that are cast together, and where their fates belong.
class Batch {
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
    cast_ += static_cast<std::int64_t>(rays_.size());
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
  const bool steady = std::all_of(sources_.begin(), sources_.end(), [](const Source& s) { return s.steady; });
  if (written_ != result.data()) {
    result.clear();
  } else if (steady && !news_.any()) {
    for (Band& band : bands_) band.casts.cast = 0;
  }
  if (written_ != result.data() || !steady || news_.any()) {
    caster_->prepare(opaque_, news_);
    std::vector<Surface> surfaces;
    for (const Source& source : sources_) surfaces.emplace_back(volume.grid, source.kind, source.now);
    workers_.run(static_cast<int>(bands_.size()),
                 [&](int i) { update(bands_[static_cast<std::size_t>(i)], surfaces, result); });
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

// A source that has just been made has power 0, as one that is off. Nothing is kept of either.
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

void KeptRays::update(Band& band, const std::vector<Surface>& surfaces,
                      state::Field<std::uint16_t>& result) const {
  erase(band, result);
  band.casts = {};
  std::size_t bytes = 0;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    renew(band, sources_[s], surfaces[s], band.sources[s]);
    bytes += band.sources[s].bytes();
  }
  band.cuts = write(band, result);
  const state::Grid& g = opaque_.grid();
  const auto cells = static_cast<std::size_t>(band.y1 - band.y0) * static_cast<std::size_t>(g.x);
  band.kept = bytes <= kMostKept * cells + (std::size_t{16} << 10);
  if (!band.kept) band.sources.assign(sources_.size(), {});
}

void KeptRays::erase(const Band& band, state::Field<std::uint16_t>& result) const {
  if (!band.kept)
    for (int y = band.y0; y < band.y1; ++y)
      std::fill_n(result.row(y, band.z), opaque_.grid().x, std::uint16_t{0});
  for (const OfSource& own : band.sources)
    for (const Lit& lit : own.cells) {
      const Cell cell = cell_at(band, lit);
      result.row(cell[1], cell[2])[cell[0]] = 0;
    }
}

std::int64_t KeptRays::write(const Band& band, state::Field<std::uint16_t>& result) const {
  std::int64_t cuts = 0;
  for (const OfSource& own : band.sources)
    for (const Lit& lit : own.cells) {
      if (lit.value == 0) continue;
      const Cell cell = cell_at(band, lit);
      std::uint16_t& sum = result.row(cell[1], cell[2])[cell[0]];
      const std::uint32_t whole = sum + lit.value;
      constexpr std::uint32_t most = rule::kIrradianceMax;
      sum = static_cast<std::uint16_t>(std::min(whole, most));
      if (whole > most) ++cuts;
    }
  return cuts;
}

void KeptRays::renew(Band& band, const Source& source, const Surface& surface, OfSource& own) const {
  if (source.now.power == 0) {
    own = {};
    return;
  }
  const bool still = source.still && band.kept;
  if (!still || opaque_.changed_about(band.z)) {
    OfSource now = find(band, surface);
    if (still) keep(own, now);
    own = std::move(now);
  }
  if (!source.steady)
    for (Lit& lit : own.cells) lit.value = kStale;
  band.casts += cast(band, source, own);
  const Fate* fates = own.fates.data();
  for (Lit& lit : own.cells) {
    if (lit.value == kStale) lit.value = value(band, source, lit, fates);
    fates += rays_of(lit);
  }
}

// All cells with faces that look, as if nothing was known of their rays.
KeptRays::OfSource KeptRays::find(const Band& band, const Surface& surface) const {
  OfSource now;
  std::size_t rays = 0;
  for (int y = band.y0; y < band.y1; ++y)
    for (std::size_t w = 0; w < opaque_.plane().row_words(); ++w) {
      const Surface::Faces faces = surface.faces(opaque_, w, y, band.z);
      std::uint64_t any = 0;
      for (const std::uint64_t word : faces) any |= word;
      for (std::uint64_t bits = any; bits != 0; bits &= bits - 1) {
        const int b = std::countr_zero(bits);
        std::uint8_t looking = 0;
        for (std::size_t f = 0; f < faces.size(); ++f)
          looking = static_cast<std::uint8_t>(looking | (faces[f] >> b & 1) << f);
        const int place = (y - band.y0) << 16 | (64 * static_cast<int>(w) + b);
        now.cells.push_back({static_cast<std::uint32_t>(place), kStale, looking});
        rays += rays_of(now.cells.back());
      }
    }
  now.fates.assign(rays, kDark);
  return now;
}

// Takes over what is known of the faces that already looked.
void KeptRays::keep(const OfSource& old, OfSource& now) const {
  const auto each = static_cast<std::size_t>(setting_.rays());
  const Fate* from = old.fates.data();
  Fate* to = now.fates.data();
  auto was = old.cells.begin();
  for (Lit& lit : now.cells) {
    for (; was != old.cells.end() && was->place < lit.place; ++was) from += rays_of(*was);
    if (was == old.cells.end() || was->place != lit.place) {
      to += rays_of(lit);
      continue;
    }
    if (was->faces == lit.faces) lit.value = was->value;
    for (int f = 0; f < rule::kFaces; ++f) {
      const bool looked = (was->faces >> f & 1) != 0, looks = (lit.faces >> f & 1) != 0;
      if (looked && looks) std::copy_n(from, each, to);
      from += looked ? each : 0;
      to += looks ? each : 0;
    }
    ++was;
  }
}

// Follows each ray of which it is not known that it sees the source, or meets a cell that is opaque now.
Casts KeptRays::cast(const Band& band, const Source& source, OfSource& own) const {
  Batch batch(*caster_, opaque_, own.fates);
  std::int64_t asked = 0;
  std::size_t place = 0;
  for (Lit& lit : own.cells) {
    const auto end = place + rays_of(lit);
    const auto known = [&](std::size_t at) {
      const Fate fate = own.fates[at];
      return fate == kSees || fate == kNone || (fate != kDark && opaque_.holds(fate));
    };
    const std::size_t first = place;
    while (place < end && known(place)) asked += own.fates[place++] != kNone;
    if (place == end) continue;  // nothing is new: so it is with most cells
    const Cell cell = cell_at(band, lit);
    rule::CellRays rays(setting_, source.kind, source.now, cell);
    std::size_t at = first;
    for (int f = 0; f < rule::kFaces; ++f) {
      if ((lit.faces >> f & 1) == 0) continue;
      rays.choose(f);
      for (int i = 0; i < setting_.side; ++i)
        for (int j = 0; j < setting_.side; ++j, ++at) {
          if (at < place) continue;
          if (!known(at)) {
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

std::size_t KeptRays::rays_of(const Lit& lit) const {
  return static_cast<std::size_t>(setting_.rays() * std::popcount(lit.faces));
}

Cell KeptRays::cell_at(const Band& band, const Lit& lit) {
  return {static_cast<int>(lit.place & 0xffff), band.y0 + static_cast<int>(lit.place >> 16), band.z};
}

std::size_t KeptRays::kept_bytes() const {
  std::size_t bytes = 0;
  for (const Band& band : bands_)
    for (const OfSource& own : band.sources) bytes += own.bytes();
  return bytes;
}

}  // namespace voxmelt::visibility
