// The command `voxmelt list` tells what this build and its scenes can do.
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/options.h"

namespace voxmelt::app {

void add_list(CommandLine& program, const std::map<std::string, std::function<void()>>& prints) {
  auto what = std::make_shared<std::string>();
  const Command command = program.add("list",
                                      "Name the implementations, scenes, features, cases, presets, devices, "
                                      "memories or faults of this build");
  command
      .option("what", *what,
              "implementations, scenes, features, cases (of accuracy); of the hardware presets, devices, "
              "memories,\n"
              "or faults (to plant)")
      .required()
      .one_of({"implementations", "scenes", "features", "cases", "presets", "devices", "memories", "faults"});
  command.runs([what, prints] {
    prints.at (*what)();
    return kDone;
  });
}

}  // namespace voxmelt::app
