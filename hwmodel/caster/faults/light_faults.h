// Light does not arrive, materials change places, or tables are read one entry too far.
#pragma once

#include <algorithm>

#include "hwmodel/caster/faults/planted.h"

namespace voxmelt::hwmodel::raycast {

class LightFaults : public Planted {
 public:
  using Planted::Planted;

  void arrived(const LookRegisters& look, Surface& surface) {
    const bool matter = surface.kind == Surface::Kind::matter;
    if (armed(Fault::arriving_shadow) && surface.light.lamp != 255) {
      Light light = surface.light;
      light.lamp = 255;
      surface.arriving =
          arriving_of(look, surface.normal, light, look.glow && (!matter || surface.mixture.w > 0));
      strike("arriving", surface.id);
    }
    if (armed(Fault::arriving_glow))
      replace("arriving", surface.id, surface.arriving.light,
              arriving_of(look, surface.normal, surface.light, false).light);
    if (!matter) return;
    if (armed(Fault::material_liquid))
      replace("material", surface.id, surface.mixture.l, 4096 - surface.mixture.l);
    if (armed(Fault::material_obstacle)) replace("material", surface.id, surface.mixture.w, 0);
    if (armed(Fault::material_tone)) {
      LookRegisters wrong = look;
      wrong.tinted = false;
      replace("material", surface.id, surface.mixture.material.diffuse,
              mixture_of(wrong, surface.matter).material.diffuse);
    }
  }

  void mirrored(const LookRegisters& look, Surface& surface) {
    const auto with = [&](const LookRegisters& wrong) {
      return mirrored_of(wrong, surface.normal, surface.to_eye, surface.light, surface.arriving,
                         surface.mixture);
    };
    if (armed(Fault::mirror_sky)) {
      LookRegisters wrong = look;
      std::copy(look.surroundings.begin() + 1, look.surroundings.end(), wrong.surroundings.begin());
      replace("mirror", surface.id, surface.mirrored.around, with(wrong).around);
    }
    if (armed(Fault::mirror_highlight)) {
      LookRegisters wrong = look;
      std::copy(look.highlight.begin() + 1, look.highlight.end(), wrong.highlight.begin());
      replace("mirror", surface.id, surface.mirrored.peak, with(wrong).peak);
    }
    if (armed(Fault::mirror_ray))
      replace("mirror", surface.id, surface.mirrored.reflected, Vec{} - surface.mirrored.reflected);
  }

  void coloured(Surface& surface) {
    if (surface.kind != Surface::Kind::matter) return;
    if (armed(Fault::colour_fresnel)) {
      Mirrored wrong = surface.mirrored;
      wrong.more = 0;
      replace("colour", surface.id, surface.sum, matter_color(surface.arriving, surface.mixture, wrong));
    }
    if (armed(Fault::colour_emission)) {
      Mixture wrong = surface.mixture;
      wrong.emission = {};
      replace("colour", surface.id, surface.sum, matter_color(surface.arriving, wrong, surface.mirrored));
    }
  }
};

}  // namespace voxmelt::hwmodel::raycast
