// Phase `melt` (docs/automaton.md, section 7). Cold cells are found before any mask changes.
#define HAS_TRANSIENTS (HEAT && (FREEZING_POINT > 0 || (PAPER && SEES_SIDES)))

// What it found before holds where it does not look.
KERNEL(find_cold)(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL const ushort* H, GLOBAL uchar* T,
                  GLOBAL const int* list, GLOBAL const int* counts, MOMENTS, int now) {
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    int a = A[i];
    uint found = 0;
    if (is_liquid(F[i], a) && H[i] < FREEZING_POINT) {
      int touches = is_blocked(F[i + 1]) || is_blocked(F[i - 1]) || is_blocked(F[i + ROW]) || is_blocked(F[i - ROW]) ||
                    is_blocked(F[i + SLICE]) || is_blocked(F[i - SLICE]);
      found = touches && a >= ONE - ONE / 64 ? FROZEN : SET;
    }
    if (T[i] == found) continue;
    T[i] = (uchar)found;
    wake(P, moments, brick, now);
  }
}

KERNEL(melt)(CONSTANTS, GLOBAL const int* tables, GLOBAL uchar* F, GLOBAL const ushort* A, GLOBAL ushort* E,
             GLOBAL ushort* H, GLOBAL uchar* T, GLOBAL long* books, GLOBAL const int* list, GLOBAL const int* counts,
             MOMENTS, int now) {
  SCRATCH
  long melted = 0, frozen = 0, reheated = 0, melted_heat = 0;
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    uint f = F[i];
    int a = A[i], h = H[i], material = (int)(f >> MATERIAL_SHIFT);
    if (!is_matter(f, a)) continue;
    if (FREEZING_POINT > 0 && T[i] == FROZEN) {
      F[i] = SOLID;
      wake(P, moments, brick, now);
      if (PAPER) {
        frozen += E[i];
        E[i] = 0;
      }
      continue;
    }
    int from = liquid_from(P, tables, material);
    if (h < from) continue;
    if ((f & SOLID) != 0u) {
      F[i] = 0;
      wake(P, moments, brick, now);
      if (material != 0) {
        int after = imin(HEAT_MAX, h - from + tables[MATERIAL_ROWS + material * MATERIAL_ROW + 3]);
        melted_heat += (long)(after - h) * a;
        H[i] = (ushort)after;
      }
      if (PAPER) {
        if (SEES_SIDES) T[i] = MELTED;
        E[i] = (ushort)a;
        melted += a;
      }
    } else if (PAPER && REHEAT > 0) {
      int e = E[i], gained = scaled(a - e, REHEAT, 0);
      E[i] = (ushort)(e + gained);
      if (gained != 0) wake(P, moments, brick, now);
      reheated += gained;
    }
  }
  if (PAPER) {
    book(books, scratch, ENERGY_MELTED, melted);
    if (FREEZING_POINT > 0) book(books, scratch, ENERGY_FROZEN, frozen);
    if (REHEAT > 0) book(books, scratch, ENERGY_REHEATED, reheated);
  }
  if (MATERIALS) book(books, scratch, HEAT_MELTED, melted_heat);
}
