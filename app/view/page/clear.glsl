// A ray goes on through clear matter (docs/picture/translucent.md).

uniform ivec3 losses;
uniform int frost, at_passing;

struct Rest {
  int surfaces, way;  // what is left of the light from behind
  ivec3 mirrored, scattered;
};

ivec3 passed(Rest rest) {
  ivec3 i = min(((rest.way >> 8) * losses) >> 12, 2047);
  return (rest.surfaces * ivec3(entry(at_passing + i.x), entry(at_passing + i.y), entry(at_passing + i.z))) >> 12;
}
int dimmed(int surfaces, int lost) { return (surfaces * (4096 - lost)) >> 12; }

// The ray crosses a surface, into matter or out of it.
void cross_surface(inout Rest rest, ivec3 q, bool enters, ivec3 to_eye) {
  ivec3 normal = normal_at(q), made_of = matter_at(q);
#ifdef OBSTACLES
  made_of.z = matter_at(q + (normal << 5)).z;
#endif
  Shine shine = shine_of(enters ? normal : -normal, normal, to_eye, light_before(q - kBias, normal), made_of);
  rest.mirrored += (passed(rest) * shine.mirrored) >> 15;
  rest.surfaces = dimmed(rest.surfaces, shine.more);
  ivec3 before = passed(rest);
  rest.surfaces = dimmed(rest.surfaces, mixed(frost, 4096, shine.obstacle));
  rest.scattered += (before - passed(rest)) * shine.scattered;
}

// The ray goes some way in matter, with the values at q.
void walk(inout Rest rest, ivec3 q, int way) {
  ivec3 made_of = matter_at(q), before = passed(rest);
  uvec4 words = light_at(q - kBias);
  int l = (made_of.x << 4) + (made_of.x >> 4), w = obstacle_share(made_of.z);
  ivec3 diffuse = mixed(mixed(solid_of(made_of).diffuse, material_of(liquid).diffuse, l), material_of(obstacle).diffuse, w);
  int beside = byte_of(words, kOpen) + byte_of(words, kOpen + 1) + byte_of(words, kOpen + 4) + byte_of(words, kOpen + 5);
  int above = ((2 * byte_of(words, kOpen + 2) + beside) * 43) >> 9;
  int below = ((2 * byte_of(words, kOpen + 3) + beside) * 43) >> 9;
  ivec3 inner = ((from_above * above + from_below * below) >> 8) + ((lamp * whole(byte_of(words, 0))) >> 9);
  rest.way = min(rest.way + way, (1 << 27) - 1);
  rest.surfaces = dimmed(rest.surfaces, w);
  rest.scattered += (before - passed(rest)) * ((inner * diffuse) >> 12);
}

// Follows the ray. Tells whether it gets to the ground. Each round looks for matter, or goes a stretch in it. What is
// costly stands here once, because shaders have all of it in line.
bool follow(inout Rest rest, Ray ray, ivec3 to_eye, Ground ground, int bias) {
  int step_length = dot3((-ray.step) >> 4, to_eye) >> 14, last = ground.found ? ground.part >> 8 : 1 << 29;
  bool within = false, at_ground = false;
  int way = 0;
  Hit hit = Hit(false, -1, 0, ivec3(0));
  for (;;) {
    bool enters = !within, leaves = false;
    if (enters) {
      hit = march(ray, hit.k + 1, last + 1);
      if (!hit.found) return ground.found;
    } else if (!at_ground) {
      for (int i = 0; i < 1 << spacing && hit.k < last; ++i) {
        int level = sample_at(hit.at + ray.step);
        leaves = level < 0;
        if (leaves) break;
        hit = Hit(true, hit.k + 1, level, hit.at + ray.step);
        way += step_length;
      }
      if (!leaves && hit.k == last) {
        at_ground = true;
        way += (step_length * (ground.part & 255)) >> 8;
      }
    }
    bool crosses = leaves || (enters && hit.k > 0);
    Crossing met = Crossing(2048, hit.at);
    if (crosses) met = crossing_between(leaves ? hit.at + ray.step : hit.at - ray.step, hit.at, hit.level);
    if (enters) {
      int place = clamp((ground.part >> 8) - (hit.k - 1), -8, 8) * 2048 + (ground.part & 255) * 8;
      if (ground.found && place <= met.part + bias) return true;
      at_ground = hit.k > last;  // within the step
      way = (step_length * ((at_ground ? place : 2048) - met.part)) >> 11;
      within = true;
    } else {
      if (leaves) way += (step_length * (2048 - met.part)) >> 11;
      walk(rest, hit.at, way);
      if (at_ground) return true;
      way = 0;
      within = !leaves;
    }
    if (crosses) cross_surface(rest, met.at, enters, to_eye);
    if (passed(rest) == ivec3(0)) return false;
  }
}
