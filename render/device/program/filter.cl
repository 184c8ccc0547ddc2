// The filter (docs/picture/field.md, sections 6 and 7).

// A place of the rim has what the nearest cell of the grid has.
KERNEL(fill_rim)(CONSTANTS, GLOBAL ushort* all, int channels) {
  FOR_PLACES(n) {
    PLACE_OF(n)
    int nearest = place_at(P, iclamp(x, 0, NX - 1), iclamp(y, 0, NY - 1), iclamp(z, 0, NZ - 1));
    if (nearest == n) continue;
    for (int c = 0; c < channels; ++c) {
      GLOBAL ushort* channel = channel_of(P, all, c);
      channel[n] = channel[nearest];
    }
  }
}

// One axis of a pass: 0 is x, 1 is y, 2 is z. The outermost places of the rim stay, and what is wrong for that comes
// no further inwards than a cell in each pass. So it never reaches the grid.
KERNEL(filter_axis)(CONSTANTS, GLOBAL const ushort* from, GLOBAL ushort* to, int channels, int axis) {
  int step = axis == 0 ? 1 : axis == 1 ? WIDE : WIDE * HIGH, side = axis == 0 ? WIDE : axis == 1 ? HIGH : DEEP;
  FOR_PLACES(n) {
    int along = n / step % side, inner = along > 0 && along < side - 1;
    for (int c = 0; c < channels; ++c) {
      ulong at = (ulong)c * (ulong)PLACES + (ulong)n;
      int value = from[at];
      if (inner) value = (from[at - step] + 2 * value + from[at + step] + 2) >> 2;
      to[at] = (ushort)value;
    }
  }
}

// Keeps the intensity after as many passes as solid, or liquid, has.
KERNEL(keep_intensity)(CONSTANTS, GLOBAL const ushort* all, GLOBAL ushort* kept) {
  FOR_PLACES(n) kept[n] = all[n];
}

// Mixes the two intensities by the filtered shares. `all` gets the result as its first channel.
KERNEL(mix_intensity)(CONSTANTS, GLOBAL ushort* all, GLOBAL const ushort* as_solid, GLOBAL const ushort* as_liquid) {
  GLOBAL const ushort* solid = channel_of(P, all, SOLID_PART);
  GLOBAL const ushort* liquid = channel_of(P, all, LIQUID_PART);
  GLOBAL const ushort* obstacle = channel_of(P, all, OBSTACLE_PART);
  FOR_PLACES(n) {
    int s = solid[n], l = liquid[n], o = obstacle[n];
    int matter = (s + l + o + 3) >> 2, soft = (l + 3) >> 2;
    int over = iclamp(5 * soft - 2 * matter, 0, 2 * matter);
    int t = matter == 0 ? 0 : 64 * over / matter;
    int weight = (t * t * (384 - 2 * t)) >> 13;
    all[n] = (ushort)((as_solid[n] * (256 - weight) + as_liquid[n] * weight + 128) >> 8);
  }
}
