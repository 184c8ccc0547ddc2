// Each instruction set has its heat kernels here, one set per combination of features.
#pragma once

#include "kernel/engine/simd/conduction.h"
#include "kernel/engine/simd/convection.h"
#include "kernel/engine/simd/distant_conduction.h"
#include "kernel/engine/simd/exchange.h"
#include "kernel/engine/simd/material_conduction.h"
#include "kernel/engine/simd/melt.h"
#include "kernel/engine/simd/wall_conduction.h"

namespace voxmelt::simd {

template <class Arch, bool kLatent>
void conduct_faces_slice(const View& view, const Step& step, int z, const OldHeat& old,
                         const TileRow* carried, const TileRow* tiles, HeatFlux& flux, const HeatTiles& found,
                         Books& books) {
  FullConduction<Arch, kLatent> full(view, step, z, old, flux);
  books.heat.conducted +=
      FaceConduction<Arch, kLatent>(view, step, z, old, flux).run(carried, tiles, full, found);
  books.heat.conducted += full.total();
}

template <class Arch, bool kLatent, class Axes>
void conduct_distant_slice(const View& view, const Step& step, int z, const OldHeat& old,
                           const TileRow* tiles, const HeatTiles& found, Books& books) {
  books.heat.conducted += DistantConduction<Arch, kLatent, Axes>(view, step, z, old).run(tiles, found);
}

template <class Arch, bool kLatent, class Axes>
void find_wall_gains_slice(const View& view, const Step& step, int z, const TileRow* tiles,
                           const WallGains& gains, TileRow* restless) {
  WallConduction<Arch, kLatent, Axes>(view, step, z, gains).find(tiles, restless);
}

template <class Arch, bool kLatent, class Axes>
void add_wall_gains_slice(const View& view, const Step& step, int z, const TileRow* tiles,
                          const WallGains& gains, const HeatTiles& found, Books& books) {
  books.heat.walls += WallConduction<Arch, kLatent, Axes>(view, step, z, gains).add(tiles, found);
}

template <class Arch, bool kLatent, class Axes>
constexpr WallKernels kWallKernels{find_wall_gains_slice<Arch, kLatent, Axes>,
                                   add_wall_gains_slice<Arch, kLatent, Axes>};

template <class Arch, class Axes>
void conduct_materials_slice(const View& view, const Step& step, int z, const OldHeat& old,
                             const TileRow* tiles, const HeatTiles& found, Books& books) {
  MaterialConduction<Arch, Axes>(view, step, z, old).run(tiles, found, books);
}

template <class Arch, class Temperature>
void convect_slice(const View& view, const Step& step, int z, const TileRow* tiles, HeatFlux& flux,
                   const HeatTiles& found, Books& books) {
  books.heat.convected += Convection<Arch, Temperature>(view, step, z, flux).run(tiles, found);
}

template <class Arch, HeatFeatures kFeatures>
void exchange_slice(const View& view, const Step& step, int z, const TileRow* tiles, const HeatTiles& found,
                    Books& books) {
  Exchange<Arch, kFeatures>(view, step, z).run(tiles, found, books);
}

template <class Arch, MeltFeatures kFeatures>
void melt_slice(const View& view, const Step& step, int z, const TileRow* tiles, TileRow* changed,
                Books& books) {
  Melt<Arch, kFeatures>(view, step, z, books).run(tiles, changed);
}

template <class Arch, class Temperature, HeatFeatures kAlways>
void choose_exchange(const rule::Heat& heat, Kernels& kernels) {
  const bool air = kBuilt.air && heat.air && (kAlways.palette || heat.air_exchange > 0 || heat.air_glow > 0);
  const bool radiation = kBuilt.radiation && heat.radiation;
  constexpr bool kLatent = kAlways.latent, kPalette = kAlways.palette;
  if (radiation && air)
    kernels.exchange = exchange_slice<Arch, HeatFeatures{kLatent, true, true, kPalette}>;
  else if (radiation)
    kernels.exchange = exchange_slice<Arch, HeatFeatures{kLatent, true, false, kPalette}>;
  else if (air)
    kernels.exchange = exchange_slice<Arch, HeatFeatures{kLatent, false, true, kPalette}>;
  if (kBuilt.convection && heat.convection > 0) kernels.convect = convect_slice<Arch, Temperature>;
}

template <class Arch, bool kLatent>
void choose_latent_kernels(const rule::Heat& heat, Kernels& kernels) {
  if (heat.weight_face > 0) kernels.conduct_faces = conduct_faces_slice<Arch, kLatent>;
  if (kBuilt.edges && heat.neighbours >= 18 && heat.weight_edge > 0)
    kernels.conduct_edges = conduct_distant_slice<Arch, kLatent, EdgeAxes<Arch>>;
  if (kBuilt.corners && heat.neighbours >= 26 && heat.weight_corner > 0)
    kernels.conduct_corners = conduct_distant_slice<Arch, kLatent, CornerAxes<Arch>>;
  if (kBuilt.walls && heat.walls) {
    kernels.face_walls = kWallKernels<Arch, kLatent, FaceAxes<Arch>>;
    kernels.edge_walls = kWallKernels<Arch, kLatent, EdgeAxes<Arch>>;
    kernels.corner_walls = kWallKernels<Arch, kLatent, CornerAxes<Arch>>;
  }
  choose_exchange<Arch, Plateau<Arch, kLatent>, HeatFeatures{kLatent, false, false}>(heat, kernels);
}

// Solids are of several materials.
template <class Arch>
void choose_palette_kernels(const rule::Heat& heat, Kernels& kernels) {
  kernels.conduct_faces_gathered = conduct_materials_slice<Arch, FaceAxes<Arch>>;
  if (kBuilt.edges && heat.neighbours >= 18)
    kernels.conduct_edges = conduct_materials_slice<Arch, EdgeAxes<Arch>>;
  if (kBuilt.corners && heat.neighbours >= 26)
    kernels.conduct_corners = conduct_materials_slice<Arch, CornerAxes<Arch>>;
  choose_exchange<Arch, Curves<Arch>, HeatFeatures{true, false, false, true}>(heat, kernels);
}

template <class Arch, bool kPaper>
void choose_melt(const rule::Parameters& parameters, Kernels& kernels) {
  kernels.freezes = kBuilt.freezing && parameters.freezes();
  if (kBuilt.materials && parameters.has_materials())
    kernels.melt = kernels.freezes ? melt_slice<Arch, MeltFeatures{kPaper, true, true}>
                                   : melt_slice<Arch, MeltFeatures{kPaper, false, true}>;
  else
    kernels.melt = kernels.freezes ? melt_slice<Arch, MeltFeatures{kPaper, true, false}>
                                   : melt_slice<Arch, MeltFeatures{kPaper, false, false}>;
}

// Sets the kernels of phases `heat` and `melt`. Without heat it leaves them null.
template <class Arch>
void choose_heat_kernels(const rule::Parameters& parameters, Kernels& kernels) {
  if (!kBuilt.heat || !parameters.heat.enabled) return;
  if (kBuilt.materials && parameters.has_materials())
    choose_palette_kernels<Arch>(parameters.heat, kernels);
  else if (kBuilt.latent && parameters.material.latent_heat > 0)
    choose_latent_kernels<Arch, true>(parameters.heat, kernels);
  else
    choose_latent_kernels<Arch, false>(parameters.heat, kernels);
  if (parameters.flow.law == rule::Law::paper)
    choose_melt<Arch, true>(parameters, kernels);
  else
    choose_melt<Arch, false>(parameters, kernels);
}

}  // namespace voxmelt::simd
