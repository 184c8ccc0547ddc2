// Light that does not arrive, materials that change places, and tables that are read one entry too far.
#pragma once

#include <algorithm>

#include "hwmodel/caster/faults/planted.h"

namespace voxmelt::hwmodel::raycast {

class LightFaults : public Planted {
 public:
  using Planted::Planted;

  void arrived(const LookRegisters& look, Surface& of) {
    const bool matter = of.kind == Surface::Kind::matter;
    if (armed(Fault::arriving_shadow) && of.light.lamp != 255) {
      Light light = of.light;
      light.lamp = 255;
      of.arriving = arriving_of(look, of.normal, light, look.glow && (!matter || of.mixture.w > 0));
      strike("arriving", of.id);
    }
    if (armed(Fault::arriving_glow))
      replace("arriving", of.id, of.arriving.light, arriving_of(look, of.normal, of.light, false).light);
    if (!matter) return;
    if (armed(Fault::material_liquid)) replace("material", of.id, of.mixture.l, 4096 - of.mixture.l);
    if (armed(Fault::material_obstacle)) replace("material", of.id, of.mixture.w, 0);
  }

  void mirrored(const LookRegisters& look, Surface& of) {
    const auto with = [&](const LookRegisters& wrong) {
      return mirrored_of(wrong, of.normal, of.to_eye, of.light, of.arriving, of.mixture);
    };
    if (armed(Fault::mirror_sky)) {
      LookRegisters wrong = look;
      std::copy(look.surroundings.begin() + 1, look.surroundings.end(), wrong.surroundings.begin());
      replace("mirror", of.id, of.mirrored.around, with(wrong).around);
    }
    if (armed(Fault::mirror_highlight)) {
      LookRegisters wrong = look;
      std::copy(look.highlight.begin() + 1, look.highlight.end(), wrong.highlight.begin());
      replace("mirror", of.id, of.mirrored.peak, with(wrong).peak);
    }
    if (armed(Fault::mirror_ray))
      replace("mirror", of.id, of.mirrored.reflected, Vec{} - of.mirrored.reflected);
  }

  void coloured(Surface& of) {
    if (of.kind != Surface::Kind::matter) return;
    if (armed(Fault::colour_fresnel)) {
      Mirrored wrong = of.mirrored;
      wrong.more = 0;
      replace("colour", of.id, of.sum, matter_color(of.arriving, of.mixture, wrong));
    }
    if (armed(Fault::colour_emission)) {
      Mixture wrong = of.mixture;
      wrong.emission = {};
      replace("colour", of.id, of.sum, matter_color(of.arriving, wrong, of.mirrored));
    }
  }
};

}  // namespace voxmelt::hwmodel::raycast
