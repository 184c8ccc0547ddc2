// A fault may be planted at these points of the stages. A stage is a template over its fault policy. At each
// point it tells the policy what it works on: itself, the words, and the value that may be made wrong. This
// policy plants nothing, is empty, and compiles to nothing. Those that plant faults are in
// hwmodel/pipeline/faults.
#pragma once

namespace voxmelt::hwmodel {

struct NoFaults {
  // Fall says whether the cell that came passes the held one, and passes the cell that leaves.
  static void judged(auto&&...) {}
  static void turned_round(auto&&...) {}
  // Source, exchange and melt pass the cell that leaves.
  static void treated(auto&&...) {}
  static void exchanged(auto&&...) {}
  static void melted(auto&&...) {}
  // Melt passes every cell that leaves before what is hot melts: some froze, and some are set.
  static void cooled(auto&&...) {}
  // Conduction, walls and viscous spread pass the cell that leaves, with what it tells later stages.
  static void gave(auto&&...) {}
  // Conduction calls `conducted` after all fluxes of the token that came. Convection calls `rested` for a
  // pair that exchanges nothing.
  static void conducted(auto&&...) {}
  static void rested(auto&&...) {}
  // Gravity passes what the upper cell releases, the lower cell after it, and a pair across the ends of two
  // columns.
  static void released(auto&&...) {}
  static void fell(auto&&...) {}
  static void column_ended(auto&&...) {}
  // Pattern passes a giver with its limits, a direction that was offered or not, and the cell with its
  // pattern.
  static void allowed(auto&&...) {}
  static void offered(auto&&...) {}
  static void drawn(auto&&...) {}
  // Apply passes what one cell gives another, and the energy of a cell to which all has come.
  static void gift(auto&&...) {}
  static void finished(auto&&...) {}
  // Settle calls these after the first scan, after the second one, and before a column is turned round the
  // second time.
  static void summed(auto&&...) {}
  static void lowered(auto&&...) {}
  static void turned(auto&&...) {}
  // Settle passes the cell that leaves, with what it shows.
  static void shown(auto&&...) {}
  // Viscous spread passes what a cell wants to give, and the taker after it.
  static void wanted(auto&&...) {}
  static void moved(auto&&...) {}
};

}  // namespace voxmelt::hwmodel
