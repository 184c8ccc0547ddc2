// What a ray meets, and the bytes of a pixel (docs/picture/definition.md, sections 9 and 10).

uniform ivec3 background;
uniform int at_bytes;
uniform int bias;            // of the ground's sides
uniform int samples;         // 1, or 8 for pixels that differ from a neighbour
uniform ivec2 size;          // of the picture
uniform sampler2D plain;     // the picture with one sample a pixel
out vec4 color;

ivec3 color_of_ground(Ground ground, ivec3 to_eye) {
  ivec3 normal, own = paint_ground(ground, to_eye, normal);
  return (arriving(normal, light_before(ground.position, normal), true) * own) >> 12;
}

#ifdef CLEAR
ivec3 light_through(uvec2 place) {
  Ray ray = ray_through(place);
  ivec3 to_eye = unit_of(-ray.step);
  Ground ground = Ground(false, 0, kNoFace, ivec3(0));
#ifdef GROUND
  ground = first_ground(ray);
#endif
  Rest rest = Rest(4096, 0, ivec3(0), ivec3(0));
  bool arrived = follow(rest, ray, to_eye, ground, ground.face == kTop ? 0 : bias);
  ivec3 share = passed(rest);
  if (arrived) return pressed(rest.mirrored + ((rest.scattered + share * color_of_ground(ground, to_eye)) >> 15));
  return min(pressed(rest.mirrored + (rest.scattered >> 15)) + ((share * background) >> 15), 4096);
}
#else
ivec3 color_of_matter(Ray ray, Hit hit, Crossing met, ivec3 to_eye) {
  ivec3 normal = hit.k == 0 ? to_eye : normal_at(met.at), made_of = matter_at(met.at);
#ifdef OBSTACLES
  made_of.z = matter_at(met.at + (normal << 5)).z;
#endif
  Shine shine = shine_of(normal, normal, to_eye, light_before(met.at - kBias, normal), made_of);
  return shine.mirrored + shine.scattered + shine.emission;
}
ivec3 light_through(uvec2 place) {
  Ray ray = ray_through(place);
  Ground ground = Ground(false, 0, kNoFace, ivec3(0));
#ifdef GROUND
  ground = first_ground(ray);
#endif
  Hit hit = march(ray, 0, ground.found ? (ground.part >> 8) + 1 : 1 << 30);
  if (!hit.found && !ground.found) return background;
  ivec3 to_eye = unit_of(-ray.step);
  if (hit.found) {
    Crossing met = crossing_of(ray, hit);
    int behind = clamp((ground.part >> 8) - (hit.k - 1), -8, 8) * 2048 + (ground.part & 255) * 8;
    if (!ground.found || behind > met.part + (ground.face == kTop ? 0 : bias))
      return pressed(color_of_matter(ray, hit, met, to_eye));
  }
  return pressed(color_of_ground(ground, to_eye));
}
#endif

ivec3 bytes_at(ivec2 pixel) {
  return ivec3(texelFetch(plain, ivec2(pixel.x, size.y - 1 - pixel.y), 0).xyz * 255.0 + 0.5);
}
bool differs(ivec3 here, ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) return false;
  return largest(here - bytes_at(pixel)) > 16;
}

void main() {
  ivec2 pixel = ivec2(int(gl_FragCoord.x), size.y - 1 - int(gl_FragCoord.y));
  if (samples > 1) {
    ivec3 here = bytes_at(pixel);
    if (!differs(here, pixel + ivec2(1, 0)) && !differs(here, pixel - ivec2(1, 0)) &&
        !differs(here, pixel + ivec2(0, 1)) && !differs(here, pixel - ivec2(0, 1))) {
      color = vec4(vec3(here) / 255.0, 1.0);
      return;
    }
  }
  const int rows[8] = int[8](3, 6, 0, 5, 2, 7, 1, 4);
  ivec3 all = ivec3(samples / 2);
  for (int i = 0; i < samples; ++i) {
    ivec2 place = samples == 1 ? ivec2(32) : ivec2(8 * i + 4, 8 * rows[i] + 4);
    all += light_through(uvec2(pixel * 64 + place));
  }
  all /= samples;
  color = vec4(vec3(entry(at_bytes + all.x), entry(at_bytes + all.y), entry(at_bytes + all.z)) / 255.0, 1.0);
}
