#include "hwmodel/rtl/write/pipeline_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "hwmodel/pipeline/model/arithmetic.h"
#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/pipeline/model/viscous_run.h"
#include "hwmodel/rtl/host/rtl_model.h"
#include "hwmodel/rtl/host/rtl_ports.h"

namespace voxmelt::hwmodel {
namespace {

// Scenes of several materials have words with heat, even where nothing is hot.
bool kept_heat(const Design& design) { return design.hot() || design.of_materials(); }
bool fed(const Design& design) { return design.hot() && design.parameters.heat.radiation; }

// Writes a number of so many bits from words of 32 bits, the lowest first.
std::string constant_of(const std::vector<std::uint32_t>& words, int bits) {
  std::string digits;
  for (auto word = words.rbegin(); word != words.rend(); ++word) digits += fmt::format("{:08x}", *word);
  const std::size_t wanted = (static_cast<std::size_t>(bits) + 3) / 4;
  return fmt::format("{}'h{}", bits, digits.substr(digits.size() - wanted));
}

int bits_of_wide(std::string_view name, const RtlSizes& sizes) {
  if (name == "keys") return 320;
  if (name == "shares") return 512;
  if (name == "table_shares") return 1024;
  if (name == "weights") return 16 << (2 * sizes.material_bits);
  if (name == "curves") return 49 << sizes.material_bits;
  if (name == "melting") return 33 << sizes.material_bits;
  if (name == "beds" || name == "air_weights") return 48 << sizes.material_bits;
  return 199 * std::max(1, static_cast<int>(sizes.vents + sizes.drains));
}

std::string upper(std::string_view name) {
  std::string text(name);
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

class Writer {
 public:
  Writer(const Design& design, const Configuration& configuration)
      : design_(design),
        c_(configuration),
        sizes_(sizes_of(design)),
        hot_(kept_heat(design) ? 1 : 0),
        energy_(energy_bits(design, sizes_)) {}

  std::string text() {
    head();
    channel("c0", Wires{}, c_.depth_of(reader_name()));
    add("  assign c0_in_valid = in_valid;\n  assign in_ready = c0_in_ready;\n");
    add("  for (genvar lane = 0; lane < {0}; lane++) begin : unpack\n", c_.lanes);
    add("    assign c0_in_cells[lane*67+:67] = 67'(in_cells[lane*{0}+:{0}]);\n  end\n\n",
        stored_bits(design_));
    int number = 0;
    const std::size_t stages = stages_of_step(design_).size();
    for (int t = 0; t < c_.cascade; ++t) {
      copy_ = 0;
      for (std::size_t i = 0; i < stages; ++i) {
        stage(i, t, ++number);
        copy_ += stages_of_step(design_)[i] == StageKind::viscous_spread ? 1 : 0;
      }
    }
    add("  assign out_valid = c{0}_valid;\n  assign c{0}_ready = out_ready;\n", number);
    add("  for (genvar lane = 0; lane < {0}; lane++) begin : pack\n", c_.lanes);
    add("    assign out_cells[lane*{0}+:{0}] = c{1}_cells[lane*67+:{0}];\n  end\nendmodule\n",
        stored_bits(design_), number);
    return std::move(text_);
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  std::string step_name(int t) const { return "step " + std::to_string(t) + ": "; }
  std::string reader_name() const {
    return step_name(0) + "reader -> " + std::string(name_of(stages_of_step(design_).front()));
  }

  void head() {
    const state::Grid& grid = design_.shape.grid;
    add("// The pipeline of a grid of {} x {} x {} cells: {} lanes, {} time steps in a row.\n", grid.x,
        grid.y, grid.z, c_.lanes, c_.cascade);
    add("// A token is {} cells along x, the lowest first: {{{}energy, amount, state}} each. A solid has its "
        "material\n// in place of the energy. Tokens come with z\n"
        "// outermost, then blocks along x, then y.\n",
        c_.lanes, hot_ != 0 ? "heat, " : "");
    add("module pipeline (\n    input  logic clk,\n    input  logic rst,\n"
        "    input  logic [31:0] first_step,  // of the first pass\n"
        "    input  logic follows,            // a pass comes behind the present one, without a gap\n");
    const int bits = c_.lanes * stored_bits(design_);
    add("    input  logic in_valid,\n    output logic in_ready,\n    input  logic [{}:0] in_cells,\n",
        bits - 1);
    for (int t = 0; fed(design_) && t < c_.cascade; ++t)
      add("    input  logic feed{0}_valid,      // irradiance for time step {0} of a pass\n"
          "    output logic feed{0}_ready,\n    input  logic [{1}:0] feed{0},\n",
          t, 16 * c_.lanes - 1);
    if (design_.parameters.pieces.fall)
      add("    input  logic falls_valid,      // which cells fall\n    output logic falls_ready,\n"
          "    input  logic [{}:0] falls,\n",
          c_.lanes - 1);
    add("    output logic out_valid,\n    input  logic out_ready,\n    output logic [{}:0] out_cells\n);\n",
        bits - 1);
  }

  // Declares a channel: NAME_in_* is its producer's side, NAME_* its consumer's.
  void channel(const std::string& name, const Wires& bands, int depth) {
    add("  logic {0}_in_valid, {0}_in_ready, {0}_valid, {0}_ready;\n  logic [{1}:0] {0}_in_cells, "
        "{0}_cells;\n  logic [{2}:0] {0}_in_runs, {0}_runs;\n  logic [{3}:0] {0}_in_shows, {0}_shows;\n",
        name, 67 * c_.lanes - 1, c_.lanes - 1, 92 * c_.lanes - 1);
    add("  cell_channel #(.P({}), .HOT({}), .ENERGY({}), .AXES({}), .PATTERN({}), .WALL({}), .TOUCHES({}), "
        ".SET({}), .RUN({}), .SHOWS({}), .DEPTH({})) {} (\n",
        c_.lanes, hot_, energy_, int{bands.has(Wire::exposed_axes)}, int{bands.has(Wire::pattern)},
        int{bands.has(Wire::beside_wall)}, int{bands.has(Wire::touches)}, int{bands.has(Wire::set)},
        int{bands.has(Wire::in_run)}, int{bands.has(Wire::head)}, depth, name);
    add("      .clk(clk), .rst(rst), .in_valid({0}_in_valid), .in_ready({0}_in_ready), "
        ".in_cells({0}_in_cells),\n      .in_runs({0}_in_runs), .in_shows({0}_in_shows), "
        ".out_valid({0}_valid), .out_ready({0}_ready),\n      .out_cells({0}_cells), .out_runs({0}_runs), "
        ".out_shows({0}_shows));\n",
        name);
    if (!bands.has(Wire::in_run)) add("  assign {}_in_runs = {}'d0;\n", name, c_.lanes);
    if (!bands.has(Wire::head)) add("  assign {}_in_shows = {}'d0;\n", name, 92 * c_.lanes);
  }

  // Writes the stage with this place in a time step, and the channel behind it.
  void stage(std::size_t place, int t, int number) {
    const StageKind kind = stages_of_step(design_)[place];
    const RtlPorts ports = rtl_ports(kind, design_, sizes_);
    const bool copied = kind == StageKind::settle || kind == StageKind::viscous_spread;
    const std::string name =
        fmt::format("t{}_{}{}", t, name_of(kind), copied ? std::to_string(copy_) : std::string());
    const int in = number - 1;
    add("  // Time step {}: {}.\n", t, name_of(kind));
    const std::string valid = side_input(kind, t, in, name);
    add("  logic {0}_ready;\n  logic [31:0] {0}_step;\n", name);
    add("  pass_step #(.TOKENS({}), .STEPS({})) {}_steps (\n      .clk(clk), .rst(rst), "
        ".first_step(first_step "
        "+ 32'd{}), .takes({} & {}_ready), .step({}_step));\n",
        design_.shape.tokens(), c_.cascade, name, t, valid, name, name);
    channel(fmt::format("c{}", number), make_stage(kind, design_)->side_bands(), depth_behind(place, t));
    add("  {}_stage #(.P({}){}) {} (\n      .clk(clk), .rst(rst), .in_valid({}), .in_ready({}_ready), "
        ".in_cells(c{}_cells),\n      .out_valid(c{}_in_valid), .out_ready(c{}_in_ready), "
        ".out_cells(c{}_in_cells),\n      .follows({}), .step({}_step)",
        name_of(kind), c_.lanes, parameters(kind, ports), name, valid, name, in, number, number, number,
        lag_of(ports) <= design_.shape.tokens() ? "follows" : "1'b0", name);
    for (const RtlPort& port : ports.values) add(",\n      .{}({}'d{})", port.name, port.bits, port.value);
    for (const auto& [wide, words] : ports.wide)
      add(",\n      .{}({})", wide, constant_of(words, bits_of_wide(wide, sizes_)));
    if (kind == StageKind::exchange)
      add(",\n      .irradiance({}), .table_write(1'b0), .table_address(12'd0), .table_data(16'd0)",
          fed(design_) ? fmt::format("feed{}", t) : fmt::format("{}'d0", 16 * c_.lanes));
    if (kind == StageKind::fall) add(",\n      .falls(falls)");
    runs_and_substeps(kind, in, number);
    add(");\n\n");
  }

  // The viscous law has one pass for all sub-steps of a step.
  void runs_and_substeps(StageKind kind, int in, int number) {
    using enum StageKind;
    const int n = design_.substeps;
    if (kind == gravity || kind == viscous_spread) add(",\n      .in_runs(c{}_runs)", in);
    if (kind == settle)
      add(",\n      .out_runs(c{0}_in_runs), .out_shows(c{0}_in_shows), .substep(16'd{1}), .pace(36'd{2})",
          number, copy_, pace_of(design_.parameters.flow, n));
    if (kind != viscous_spread) return;
    std::uint64_t turns = 0;
    for (int axis = 0; axis < 4; ++axis)
      turns |= static_cast<std::uint64_t>(turn_of(copy_, n, axis)) << (10 * axis);
    add(",\n      .in_shows(c{}_shows), .out_runs(c{}_in_runs), .substep(16'd{}), .reciprocal(37'd{}), "
        ".turns(40'd{})",
        in, number, copy_, Reciprocal(n).value(), turns);
  }

  static std::int64_t lag_of(const RtlPorts& ports) {
    for (const RtlPort& port : ports.values)
      if (port.name == "lag") return static_cast<std::int64_t>(port.value);
    return 0;
  }

  // Joins a second input to the tokens of a stage. Returns the name of what says that a token is there.
  std::string side_input(StageKind kind, int t, int in, const std::string& name) {
    std::string side;
    if (kind == StageKind::exchange && fed(design_)) side = fmt::format("feed{}", t);
    if (kind == StageKind::fall) side = "falls";
    if (side.empty()) {
      add("  assign c{}_ready = {}_ready;\n", in, name);
      return fmt::format("c{}_valid", in);
    }
    add("  wire {0}_valid = c{1}_valid & {2}_valid;\n  assign c{1}_ready = {0}_ready & {2}_valid;\n"
        "  assign {2}_ready = {0}_ready & c{1}_valid;\n",
        name, in, side);
    return name + "_valid";
  }

  // The parameters of a stage beside the lanes: word widths and depths of memories.
  std::string parameters(StageKind kind, const RtlPorts& ports) const {
    using enum StageKind;
    std::string text;
    if (kind == walls || kind == pattern || kind == apply || kind == fall || kind == settle ||
        kind == viscous_spread)
      text += fmt::format(", .HOT({})", hot_);
    if (kind == apply) {
      const rule::PaperLaw& law = design_.parameters.flow.paper;
      text += fmt::format(", .TABLE({}), .PRINTED({}), .FOUR({})", int{law.use_table},
                          int{law.reading == rule::EnergyReading::printed}, int{law.neighbours != 8});
    }
    if (kind == conduction || kind == edges || kind == corners)
      text +=
          fmt::format(", .AXES({}), .WALL({}), .TOUCHES({}), .ENERGY({})", int{design_.parameters.heat.air},
                      int{design_.walls_in_conduction()}, int{design_.freezes()}, energy_);
    if (sizes_.material_bits > 0 &&
        (kind == conduction || kind == edges || kind == corners || kind == exchange || kind == melt ||
         kind == settle || kind == viscous_spread))
      text += fmt::format(", .MATERIALS({})", sizes_.material_bits);
    if (kind == source) text += fmt::format(", .VENTS({}), .DRAINS({})", sizes_.vents, sizes_.drains);
    if (kind == exchange) {
      text += fmt::format(", .HEIGHT({})", design_.parameters.heat.air ? design_.shape.grid.y : 1);
      if (design_.parameters.heat.air) text += ", .AIR(\"air.hex\")";
    }
    if (kind == settle) {
      const RunWidths widths(design_);
      text += fmt::format(", .THERMAL({}), .FREEZES({}), .SUM({}), .LAST({}), .HEIGHT({})",
                          int{hot_ != 0 && design_.parameters.flow.thermal_viscosity}, int{design_.freezes()},
                          widths.sum, widths.count, design_.shape.grid.y);
    }
    if (kind == viscous_spread) text += fmt::format(", .BLOCKS({})", design_.shape.blocks());
    for (const RtlPort& port : ports.values)
      if (is_memory(port.name)) text += fmt::format(", .DEPTH_{}({})", upper(port.name), port.value - 1);
    return text;
  }

  int depth_behind(std::size_t place, int t) const {
    const std::vector<StageKind> stages = stages_of_step(design_);
    const StageKind kind = stages[place];
    const bool last = place + 1 == stages.size();
    const std::string_view next = !last                 ? name_of(stages[place + 1])
                                  : t + 1 == c_.cascade ? std::string_view("writer")
                                                        : name_of(stages.front());
    return c_.depth_of(step_name(t) + std::string(name_of(kind)) + " -> " + std::string(next));
  }

  const Design& design_;
  const Configuration& c_;
  RtlSizes sizes_;
  int hot_, energy_;
  int copy_ = 0;  // which sub-step settle and spread are of
  std::string text_;
};

}  // namespace

int stored_bits(const Design& design) { return kept_heat(design) ? 50 : 34; }

std::vector<std::uint16_t> air_words(const Design& design) {
  const auto& air = design.parameters.heat.air_temperature;
  return design.hot() && design.parameters.heat.air ? std::vector<std::uint16_t>(air.begin(), air.end())
                                                    : std::vector<std::uint16_t>{};
}

std::string unwritten(const Design& design, const Configuration& configuration) {
  if (design.parameters.pieces.fall && configuration.cascade > 1) return "where pieces fall, hw.cascade is 1";
  if (configuration.lanes > 16 || (configuration.lanes & (configuration.lanes - 1)) != 0)
    return "hw.lanes is 1, 2, 4, 8 or 16";
  const int substeps = design.parameters.flow.viscous.substeps;
  if (!design.paper() && substeps != configuration.substeps)
    return substeps == 0 ? std::string(
                               "the number of sub-steps follows from the state; set it by "
                               "flow.viscous.substeps and hw.substeps")
                         : "a step has " + std::to_string(substeps) + " sub-steps, and hw.substeps is " +
                               std::to_string(configuration.substeps);
  for (const StageKind kind : stages_of_step(design))
    if (const RtlPorts ports = rtl_ports(kind, design, sizes_of(design)); !ports.refusal.empty())
      return std::string(name_of(kind)) + ": " + ports.refusal;
  return {};
}

std::string pipeline_text(const Design& design, const Configuration& configuration) {
  return Writer(design, configuration).text();
}

}  // namespace voxmelt::hwmodel
