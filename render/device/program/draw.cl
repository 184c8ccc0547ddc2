// A picture, a pixel an item (docs/picture/definition.md, sections 9 and 10).
FN Color pressed(PAINT, Color light) {
  for (int c = 0; c < 3; ++c) light.c[c] = K[TONES + iclamp(light.c[c], 0, 12287)];
  return light;
}

FN Color color_of_ground(SCENE, GroundCrossing met, Vec to_eye) {
  Vec normal = normal_of_ground(P, K, ground, met.position, met.face);
  Vec color = met.face == UPPER ? color_of_top(P, V, K, texels, met.position, &normal) : color_of_cut(P, V, ground, met);
  if (met.face == NO_FACE) normal = to_eye;
  Light light = light_before(V, K, lights, met.position, normal);
  Color sum = arriving_light(K, normal, &light, GLOWS);
  sum.c[0] = (int)((sum.c[0] * (int)color.x) >> 12);
  sum.c[1] = (int)((sum.c[1] * (int)color.y) >> 12);
  sum.c[2] = (int)((sum.c[2] * (int)color.z) >> 12);
  return sum;
}

// The light of a ray that may go on through matter.
FN Color clear_light(SCENE, Ray ray, GroundCrossing met, Crossing matter, Vec to_eye) {
  Walk walk = {ray, to_eye, 0, LIGHT_ONE, 0, {0, 0, 0}, {0, 0, 0}};
  walk.step = dot_of(shifted(opposite_of(ray.way), 4), to_eye) >> LENGTH_BITS;
  int to_ground = follow(THIS_SCENE, &walk, met, matter);
  Color behind = {{0, 0, 0}};
  if (to_ground) behind = color_of_ground(THIS_SCENE, met, to_eye);
  Color share = passed_by(K, &walk), sum;
  for (int c = 0; c < 3; ++c)
    sum.c[c] = walk.mirrored[c] + ((walk.scattered[c] + share.c[c] * behind.c[c]) >> 15);
  sum = pressed(K, sum);
  if (!to_ground)
    for (int c = 0; c < 3; ++c) sum.c[c] = imin(sum.c[c] + ((share.c[c] * K[BACKGROUND + c]) >> 15), LIGHT_ONE);
  return sum;
}

// The light through a place of the picture, in 64ths of a pixel.
FN Color light_through(SCENE, int across, int down) {
  Ray ray = ray_through(V, across, down);
  Crossing matter = first_crossing(P, V, levels, blocks, ray, 0);
  GroundCrossing met = first_ground(P, V, ground, ray);
  Vec to_eye = unit_of(K, opposite_of(ray.way));
  if (CLEAR) return clear_light(THIS_SCENE, ray, met, matter, to_eye);
  if (ground_is_first(V, met, matter)) return pressed(K, color_of_ground(THIS_SCENE, met, to_eye));
  Color sum = {{K[BACKGROUND], K[BACKGROUND + 1], K[BACKGROUND + 2]}};
  if (!matter.found) return sum;
  Vec normal = matter.sample == 0 ? to_eye : normal_at(P, K, levels, matter.position);
  return pressed(K, color_of_matter(P, V, K, shares, lights, matter.position, normal, to_eye));
}

// One sample a pixel. Items of a group lie beside each other in the picture.
KERNEL(draw_middles)(SCENE, GLOBAL uchar* image) {
  int across = (WIDTH + LANES_X - 1) / LANES_X, down = (HEIGHT + LANES_Y - 1) / LANES_Y;
  for (int tile = GROUP; tile < across * down; tile += GROUPS) {
    int x = tile % across * LANES_X + LANE_X, y = tile / across * LANES_Y + LANE_Y;
    if (x >= WIDTH || y >= HEIGHT) continue;
    Color light = light_through(THIS_SCENE, 64 * x + 32, 64 * y + 32);
    for (int c = 0; c < 3; ++c) image[3 * (y * WIDTH + x) + c] = (uchar)K[BYTES + light.c[c]];
  }
}

FN int differs_from(GLOBAL const uchar* image, int a, int b, int most) {
  int found = 0;
  for (int c = 0; c < 3; ++c) {
    int apart = image[3 * a + c] - image[3 * b + c];
    found |= apart > most || -apart > most;
  }
  return found;
}
// Lists the pixels that differ from a neighbour. Their order is any, and no pixel depends on it.
KERNEL(find_differing)(VIEW, GLOBAL const uchar* image, GLOBAL int* list, GLOBAL int* count, int most) {
  for (int n = GROUP * LANES + LANE; n < WIDTH * HEIGHT; n += GROUPS * LANES) {
    int x = n % WIDTH, y = n / WIDTH;
    if ((x > 0 && differs_from(image, n, n - 1, most)) || (x < WIDTH - 1 && differs_from(image, n, n + 1, most)) ||
        (y > 0 && differs_from(image, n, n - WIDTH, most)) || (y < HEIGHT - 1 && differs_from(image, n, n + WIDTH, most)))
      list[NEXT(count)] = n;
  }
}

TABLE int EIGHT_ROWS[8] = {3, 6, 0, 5, 2, 7, 1, 4};
TABLE int MANY_ROWS[32] = {2,  15, 24, 28, 12, 4,  20, 16, 7,  22, 31, 1, 8,  14, 27, 11,
                           19, 25, 30, 5,  21, 10, 3,  26, 17, 0,  13, 6, 23, 9,  29, 18};

KERNEL(refine)(SCENE, GLOBAL const int* list, GLOBAL const int* count, int samples, GLOBAL uchar* image) {
  int apart = 64 / samples;
  for (int n = GROUP * LANES + LANE; n < count[0]; n += GROUPS * LANES) {
    int x = list[n] % WIDTH, y = list[n] / WIDTH, sum[3] = {samples / 2, samples / 2, samples / 2};
    for (int i = 0; i < samples; ++i) {
      int row = samples == 8 ? EIGHT_ROWS[i & 7] : MANY_ROWS[i];
      Color light = light_through(THIS_SCENE, 64 * x + apart * i + apart / 2, 64 * y + apart * row + apart / 2);
      for (int c = 0; c < 3; ++c) sum[c] += light.c[c];
    }
    for (int c = 0; c < 3; ++c) image[3 * list[n] + c] = (uchar)K[BYTES + sum[c] / samples];
  }
}
