// Copies as many words as there are, to tell how fast the memory can be. No step asks for it.
KERNEL(copy_words)(GLOBAL const uint* from, GLOBAL uint* to, int count) {
  for (int n = GROUP * LANES + LANE; n < count; n += GROUPS * LANES) to[n] = from[n];
}
