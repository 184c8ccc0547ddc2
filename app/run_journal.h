// A command makes the changes of its scene, [[change]], and those of a journal (docs/view.md), when their
// steps have come.
#pragma once

#include <string>

#include "app/command_line.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "library/by_hand.h"
#include "library/journal/journal.h"
#include "library/journal/world.h"

namespace voxmelt::app {

Option add_journal(Command command, std::string& file);  // the option
// Returns the text of a journal, which is right. No file gives none. Throws UsageError with file:line:column.
std::string journal_text(const std::string& file);

class RunJournal {
 public:
  RunJournal(scene::Scene& scene, run::Simulation& simulation) : RunJournal({}, {}, scene, simulation) {}
  // Goes on with the lines from the present step on. `name` is for messages.
  RunJournal(const std::string& text, const std::string& name, scene::Scene& scene,
             run::Simulation& simulation);

  // Makes the changes of the present step, those of the scene last. It returns true if there were any. Throws
  // UsageError with the place of a line that the simulation refuses.
  bool apply();
  std::string settings() const { return by_hand_.settings(); }  // those of the scene, as they are now

 private:
  library::ByHand by_hand_;
  journal::WorldOf<library::ByHand> world_;
  journal::Reader reader_, timeline_;  // of the journal, and of the scene
};

}  // namespace voxmelt::app
