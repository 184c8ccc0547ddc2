// The subcommands. Each adds itself to the program, and `run` of the chosen one gives the exit code.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace voxmelt::app {

using Chosen = std::function<int()>;

void add_run(CLI::App& program, Chosen& chosen);
void add_digest(CLI::App& program, Chosen& chosen);
void add_export(CLI::App& program, Chosen& chosen);
void add_render(CLI::App& program, Chosen& chosen);
void add_bench(CLI::App& program, Chosen& chosen);
void add_accuracy(CLI::App& program, Chosen& chosen);
void add_verify(CLI::App& program, Chosen& chosen);
void add_explore(CLI::App& program, Chosen& chosen);
void add_info(CLI::App& program, Chosen& chosen);
void add_list(CLI::App& program, Chosen& chosen);

}  // namespace voxmelt::app
