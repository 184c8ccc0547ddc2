#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "hwmodel/rtl/write/pipeline_text.h"

namespace voxmelt::hwmodel {
namespace {

constexpr const char* kBenchHead =
    R"(// Streams the vectors through the pipeline, and compares what comes out. With +stalls=N, N of 8 cycles wait at
// each end. It ends with an error at the first difference.
module testbench;
  localparam TOKENS = {tokens}, WIDTH = {width};
  logic clk = 1'b0, rst = 1'b1, follows = 1'b1;
  logic in_valid, in_ready, out_valid, out_ready;
  logic [WIDTH-1:0] in_words[0:TOKENS-1], out_words[0:TOKENS-1];
  logic [WIDTH-1:0] out_cells;
  integer sent = 0, got = 0, cycles = 0, stalls = 0;
  logic [31:0] random = 32'd1;
  logic offers = 1'b1, takes = 1'b1;
  assign in_valid = sent < TOKENS & offers;
  assign out_ready = takes;
)";

constexpr const char* kBenchTail = R"(
  initial begin
    $readmemh("in.hex", in_words);
    $readmemh("out.hex", out_words);
{reads}    if ($value$plusargs("stalls=%d", stalls) == 0) stalls = 0;
  end

  always #1 clk = ~clk;

  always @(posedge clk) begin
    cycles <= cycles + 1;
    if (cycles == 3) rst <= 1'b0;
    // Galois' register of 32 bits.
    random <= random[0] ? (random >> 1) ^ 32'hA3000000 : random >> 1;
    offers <= 32'(random[2:0]) >= stalls;
    takes <= 32'(random[9:7]) >= stalls;
    if (!rst & in_valid & in_ready) sent <= sent + 1;
    if (sent >= TOKENS - 1) follows <= 1'b0;
{moves}    if (!rst & out_valid & out_ready) begin
      got <= got + 1;
      if (out_cells !== out_words[got]) begin
        $display("token %0d differs: %h, expected %h", got, out_cells, out_words[got]);
        $fatal(1);
      end
      if (got == TOKENS - 1) begin
        $display("%0d tokens, no difference; %0d cycles", TOKENS, cycles - 4);
        $finish;
      end
    end
    if (cycles > 100 * TOKENS + 1000000) begin
      $display("it hangs: %0d tokens came in, %0d came out", sent, got);
      $fatal(1);
    end
  end
endmodule
)";

}  // namespace

std::string bench_text(const Design& design, const Configuration& c, std::int64_t passes,
                       std::uint32_t first_step) {
  const std::int64_t tokens = passes * design.shape.tokens();
  std::string signals, pins, reads, moves;
  const auto side = [&](const std::string& name, const std::string& file, int width) {
    signals += fmt::format(
        "  logic {0}_valid, {0}_ready;\n  logic [{1}:0] {0}_words[0:TOKENS-1];\n"
        "  integer {0}_sent = 0;\n  assign {0}_valid = {0}_sent < TOKENS;\n",
        name, width - 1);
    pins += fmt::format(
        "      .{0}_valid({0}_valid), .{0}_ready({0}_ready), "
        ".{0}({0}_words[{0}_sent < TOKENS ? {0}_sent : 0]),\n",
        name);
    reads += fmt::format("    $readmemh(\"{}\", {}_words);\n", file, name);
    moves += fmt::format("    if (!rst & {0}_valid & {0}_ready) {0}_sent <= {0}_sent + 1;\n", name);
  };
  for (int t = 0; design.hot() && design.parameters.heat.radiation && t < c.cascade; ++t)
    side(fmt::format("feed{}", t), fmt::format("feed_{}.hex", t), 16 * c.lanes);
  if (design.parameters.pieces.fall) side("falls", "falls.hex", c.lanes);

  std::string text =
      fmt::format(kBenchHead, fmt::arg("tokens", tokens), fmt::arg("width", c.lanes * stored_bits(design)));
  text += signals;
  text += fmt::format(
      "  pipeline device (\n      .clk(clk), .rst(rst), .first_step(32'd{}), .follows(follows), "
      ".in_valid(in_valid),\n      .in_ready(in_ready), .in_cells(in_words[sent < TOKENS ? sent : 0]),\n{}"
      "      .out_valid(out_valid), .out_ready(out_ready), .out_cells(out_cells));\n",
      first_step, pins);
  return text + fmt::format(kBenchTail, fmt::arg("reads", reads), fmt::arg("moves", moves));
}

}  // namespace voxmelt::hwmodel
