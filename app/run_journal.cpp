#include "app/run_journal.h"

#include "app/message.h"
#include "kernel/scene/scene.h"
#include "library/journal/timeline.h"
#include "voxmelt/errors.h"

namespace voxmelt::app {
namespace {

// The other commands have the kernel's errors.
template <class Work>
decltype(auto) in_our_errors(const Work& work) {
  try {
    return work();
  } catch (const ResourceError& error) {
    throw scene::ResourceError(error.what());
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

Option add_journal(Command command, std::string& file) {
  return command.option("--journal", file, "make the changes of a journal of `voxmelt view`");
}

std::string journal_text(const std::string& file) {
  if (file.empty()) return {};
  return in_our_errors([&] {
    std::string text = journal::read_text(file);
    journal::parse_journal(text, file);
    return text;
  });
}

RunJournal::RunJournal(const std::string& text, const std::string& name, scene::Scene& scene,
                       run::Simulation& simulation)
    : by_hand_(scene, simulation),
      world_(by_hand_),
      reader_(journal::parse_journal(text, name)),
      timeline_(in_our_errors([&] { return journal::timeline_of(scene); })) {
  reader_.seek(simulation.steps_done());
  timeline_.seek(simulation.steps_done());
}

bool RunJournal::apply() {
  bool any = false;
  const auto tell = [&](const journal::Change&) { any = true; };
  in_our_errors([&] {
    reader_.apply(world_, tell);
    timeline_.apply(world_, tell);
  });
  return any;
}

}  // namespace voxmelt::app
