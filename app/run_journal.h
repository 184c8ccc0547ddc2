// `voxmelt run` and `voxmelt digest` make the changes of a journal (docs/view.md) when their steps have come.
#pragma once

#include <string>

#include "app/command_line.h"
#include "app/journal/journal.h"
#include "app/journal/world.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "library/by_hand.h"

namespace voxmelt::app {

Option add_journal(Command command, std::string& file);  // the option
// Returns the text of a journal, which is right. No file gives none. Throws UsageError with file:line:column.
std::string journal_text(const std::string& file);

class RunJournal {
 public:
  // Goes on with the lines from the present step on. `name` is for messages.
  RunJournal(const std::string& text, const std::string& name, scene::Scene& scene,
             run::Simulation& simulation);

  // Makes the changes of the present step. It returns true if there were any. Throws UsageError with the
  // place of a line that the simulation refuses.
  bool apply();
  std::string settings() const { return by_hand_.settings(); }  // those of the scene, as they are now

 private:
  library::ByHand by_hand_;
  journal::WorldOf<library::ByHand> world_;
  journal::Reader reader_;
};

}  // namespace voxmelt::app
