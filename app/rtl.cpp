// The command `voxmelt rtl` writes the pipeline of a scene in SystemVerilog, with a test bench and scripts.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/beginning.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/programs.h"
#include "app/resources.h"
#include "app/run_ahead.h"
#include "app/shell_word.h"
#include "app/verify_command.h"
#include "app/visibility.h"
#include "hwmodel/machine/presets/presets.h"
#include "hwmodel/pipeline/check/falling.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/rtl/write/pipeline_text.h"
#include "hwmodel/rtl/write/vectors.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

struct RtlCommand {
  Common common;
  std::uint32_t passes = 2, from = 0;
  std::string from_text = "0", hw, out;
  std::vector<std::string> hw_sets;
};

std::string makefile_of() {
  return R"(# make          compiles the test bench with Verilator, and streams the vectors without and with stalls
# make BLOCKS=1 does so with products as multiplier blocks have them, make AXI=1 through AXI4-Stream
# make xilinx   synthesises the pipeline with Yosys for UltraScale+; likewise ecp5, ice40
# make place    places and routes it on an iCE40 HX8K, with nextpnr-ice40
SOURCES := voxmelt_pkg.sv $(filter-out voxmelt_pkg.sv testbench.sv, $(wildcard *.sv))

test: built/testbench
	./built/testbench +stalls=0
	./built/testbench +stalls=3

built/testbench: testbench.sv $(SOURCES)
	verilator --binary --timing $(if $(BLOCKS),-DVOXMELT_BLOCKS) $(if $(AXI),-DVOXMELT_AXI) -O3 -Wno-fatal -Wno-lint -Wno-style --x-assign unique --x-initial unique \
	  --top-module testbench --Mdir built -o testbench $(SOURCES) testbench.sv

xilinx ecp5 ice40: $(SOURCES)
	yosys -l $@.log -p "read_verilog -sv $(if $(filter ice40,$@),,-DVOXMELT_BLOCKS) $(SOURCES); hierarchy -check -top pipeline; proc; check -assert; \
	  synth_$@ $(if $(filter xilinx,$@),-family xcup) -top pipeline; stat"

place: $(SOURCES)
	yosys -q -l place.log -p "read_verilog -sv $(SOURCES); hierarchy -check -top pipeline; proc; check -assert; \
	  synth_ice40 -top pipeline -json pipeline.json; stat"
	nextpnr-ice40 --hx8k --package ct256 --pcf-allow-unconstrained --json pipeline.json --asc pipeline.asc

clean:
	rm -rf built *.log pipeline.json pipeline.asc

.PHONY: test xilinx ecp5 ice40 place clean
)";
}

std::string readme_of(const scene::Scene& scene, const hwmodel::Configuration& c, std::uint32_t first_step,
                      std::uint32_t passes) {
  return fmt::format(
      "# {}: its pipeline in SystemVerilog\n\n"
      "`pipeline.sv` is the top: {} lanes, {} time steps in a row. All numbers of the scene are constants "
      "in\n"
      "it. The other files are its parts; `voxmelt_pkg.sv` is read first. `axi_pipeline.sv` puts it behind\n"
      "AXI4-Stream.\n\n"
      "`make` streams {} passes through it, from step {} of the scene on, and compares every token with "
      "what\n"
      "the software gives. That wants Verilator 5. `make ecp5`, `make xilinx` and `make ice40` synthesise "
      "it\n"
      "with Yosys.\n",
      name_of(scene), c.lanes, c.cascade, passes, first_step);
}

// Runs the software, and notes what goes into the pipeline and comes out of it.
struct Vectors {
  std::string in, out, falls;
  std::vector<std::string> feeds;
};
Vectors vectors_of(run::Simulation& simulation, const hwmodel::Design& design, int cascade,
                   std::uint32_t passes) {
  const rule::Parameters& parameters = design.parameters;
  Vectors vectors;
  vectors.feeds.resize(design.hot() && parameters.heat.radiation ? cascade : 0);
  const int bits = hwmodel::stored_bits(design);
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    vectors.in += hwmodel::cell_lines(simulation.volume(), design.shape, bits);
    for (int t = 0; t < cascade; ++t) {
      simulation.begin_step();
      if (!vectors.feeds.empty())
        vectors.feeds[t] += hwmodel::irradiance_lines(simulation.irradiance(), design.shape);
      if (parameters.pieces.fall) {
        const auto falling =
            hwmodel::cells_that_fall(parameters, simulation.step_number(), simulation.volume());
        vectors.falls += hwmodel::fall_lines(falling ? &*falling : nullptr, design.shape);
      }
      simulation.step();
    }
    vectors.out += hwmodel::cell_lines(simulation.volume(), design.shape, bits);
  }
  return vectors;
}

void copy_sources(const fs::path& folder) {
  const fs::path sources = resource_folder("rtl");
  int files = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(sources, error))
    if (entry.path().extension() == ".sv") {
      std::ifstream source(entry.path(), std::ios::binary);
      std::stringstream text;
      text << source.rdbuf();
      if (!source) break;
      io::write_file(folder / entry.path().filename(), text.str());
      ++files;
    }
  if (files == 0)
    throw UsageError(
        fmt::format("error: {}: the sources in SystemVerilog that came with the program are not there",
                    sources.string()));
}

void write_folder(const fs::path& folder, const hwmodel::Design& design, const hwmodel::Configuration& c,
                  const Vectors& vectors, std::uint32_t passes, std::uint32_t first_step,
                  const std::string& readme) {
  copy_sources(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    io::write_file(folder / name, text);
  };
  write("pipeline.sv", hwmodel::pipeline_text(design, c));
  write("axi_pipeline.sv", hwmodel::axi_text(design, c));
  write("testbench.sv", hwmodel::bench_text(design, c, passes, first_step));
  write("in.hex", vectors.in);
  write("out.hex", vectors.out);
  for (std::size_t t = 0; t < vectors.feeds.size(); ++t)
    write(fmt::format("feed_{}.hex", t), vectors.feeds[t]);
  if (!vectors.falls.empty()) write("falls.hex", vectors.falls);
  std::string air;
  for (const std::uint16_t word : hwmodel::air_words(design)) air += fmt::format("{:04x}\n", word);
  if (!air.empty()) write("air.hex", air);
  write("Makefile", makefile_of());
  write("README.md", readme);
}

int run_rtl(RtlCommand command) {
  std::vector<std::string> sets;
  for (std::string& set : command.common.sets)
    (set.starts_with("hw.") ? command.hw_sets : sets).push_back(std::move(set));
  command.common.sets = std::move(sets);
  if (command.out.empty()) throw UsageError("error: --out DIR: the folder that is written must be named");

  const hwmodel::Preset preset = hwmodel::load_preset(find_preset(command.hw), command.hw_sets);
  const hwmodel::Configuration& c = preset.configuration;
  Beginning begin = begin_from(command.common, command.from_text);
  refuse_changes(begin.scene, "rtl");
  scene::Scene scene = std::move(begin.scene);
  check_pipeline(scene, c);
  const hwmodel::Design design = hwmodel::design_of(scene.parameters, scene.initial.grid, c);
  if (const std::string why = hwmodel::unwritten(design, c); !why.empty())
    throw UsageError(fmt::format("error: {}: {}", scene.file.string(), why));
  keep_inputs(scene, {{"--out", command.out}});
  end_soon_at_interrupts();
  io::OutputFolder out(command.out);

  const std::uint32_t steps = command.passes * static_cast<std::uint32_t>(c.cascade);
  run::Simulation simulation = run_ahead(scene, command.common, begin.steps, steps);
  const std::uint32_t first_step = simulation.step_number();
  const Vectors vectors = vectors_of(simulation, design, c.cascade, command.passes);
  write_folder(out.partial(), design, c, vectors, command.passes, first_step,
               readme_of(scene, c, first_step, command.passes));
  out.commit();
  if (!command.common.quiet)
    print("pipeline, test bench and scripts  {}/\n`make -C {}` streams steps {} to {} through it\n",
          seen_from_here(out.place()), shell_word(seen_from_here(out.place())), first_step,
          first_step + steps);
  return kDone;
}

}  // namespace

void add_rtl(CommandLine& program) {
  auto options = std::make_shared<RtlCommand>();
  const Command command = program.add("rtl", std::string(description_of("rtl")));
  add_scene(command, options->common);
  command.option("--out", options->out, "folder for sources, test bench, vectors and scripts");
  command.option("--hw", options->hw,
                 "hardware configuration: a TOML file, or a name of `voxmelt list presets`");
  command.option("--passes", options->passes, "passes that the test bench streams")
      .within(1u, 1000u)
      .shows_default();
  command
      .option("--from", options->from_text,
              "steps that the software runs first (mid-melt), or a checkpoint of the scene")
      .shows_default();
  add_common(command, options->common);
  add_visibility(command, options->common);
  command.runs([options] { return run_rtl(*options); });
}

}  // namespace voxmelt::app
