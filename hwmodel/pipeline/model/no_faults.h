// The points of the stages at which a fault may be planted. A stage is a template over its fault policy, and
// tells it at each point what it works on: itself, the words, and the value that may be made wrong. This
// policy plants nothing, is empty, and compiles to nothing; hwmodel/pipeline/faults has those that do.
#pragma once

namespace voxmelt::hwmodel {

struct NoFaults {
  // source, exchange, melt: the cell that leaves
  static void treated(auto&&...) {}
  static void exchanged(auto&&...) {}
  static void melted(auto&&...) {}
  // conduction, walls, viscous spread: the cell that leaves, with what it tells later stages
  static void gave(auto&&...) {}
  // conduction: all fluxes of the token that came; convection: a pair that exchanges nothing
  static void conducted(auto&&...) {}
  static void rested(auto&&...) {}
  // gravity: what the upper cell lets go; the lower cell after it; a pair across the columns' ends
  static void released(auto&&...) {}
  static void fell(auto&&...) {}
  static void column_ended(auto&&...) {}
  // pattern: a direction that was offered or not; the cell with its pattern
  static void offered(auto&&...) {}
  static void drawn(auto&&...) {}
  // apply: what one cell gives another; the energy of a cell to which all has come
  static void gift(auto&&...) {}
  static void finished(auto&&...) {}
  // settle: the words after the first scan, and after the second; the column that is turned round the second
  // time
  static void summed(auto&&...) {}
  static void lowered(auto&&...) {}
  static void turned(auto&&...) {}
  // settle: the cell that leaves, with what it shows
  static void shown(auto&&...) {}
  // viscous spread: what a cell wants to give; the taker after it
  static void wanted(auto&&...) {}
  static void moved(auto&&...) {}
};

}  // namespace voxmelt::hwmodel
