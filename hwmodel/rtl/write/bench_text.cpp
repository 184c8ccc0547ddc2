#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "hwmodel/rtl/write/pipeline_text.h"

namespace voxmelt::hwmodel {
namespace {

constexpr const char* kBenchHead =
    R"(// Streams the vectors through the pipeline, and compares what comes out. With +stalls=N, N of 8 cycles wait at
// each end. It ends with an error at the first difference. With +load it only reads the vectors.
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

constexpr const char* kDevices = R"(
`ifdef VOXMELT_AXI
  logic [{bits}-1:0] axi_cells;
  logic last;
  assign out_cells = axi_cells[WIDTH-1:0];
  axi_pipeline device (
      .aclk(clk), .aresetn(~rst), .first_step(32'd{step}), .follows(follows), .s_axis_cells_tvalid(in_valid),
      .s_axis_cells_tready(in_ready), .s_axis_cells_tdata({bits}'(in_words[sent < TOKENS ? sent : 0])),
{axi_pins}      .m_axis_cells_tvalid(out_valid), .m_axis_cells_tready(out_ready), .m_axis_cells_tdata(axi_cells),
      .m_axis_cells_tlast(last));
  always @(posedge clk)
    if (!rst & out_valid & out_ready & (last != (got % {pass} == {pass} - 1) | axi_cells >> WIDTH != 0)) begin
      $display("token %0d: TLAST is %0d, data are %h", got, last, axi_cells);
      $fatal(1);
    end
`else
  pipeline device (
      .clk(clk), .rst(rst), .first_step(32'd{step}), .follows(follows), .in_valid(in_valid),
      .in_ready(in_ready), .in_cells(in_words[sent < TOKENS ? sent : 0]),
{pins}      .out_valid(out_valid), .out_ready(out_ready), .out_cells(out_cells));
`endif
)";

constexpr const char* kBenchTail = R"(
  initial begin
    $readmemh("in.hex", in_words);
    $readmemh("out.hex", out_words);
{reads}    if ($value$plusargs("stalls=%d", stalls) == 0) stalls = 0;
    if ($test$plusargs("load") != 0) $finish;
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
  const int width = c.lanes * stored_bits(design);
  std::string signals, pins, axi_pins, reads, moves;
  for (const SideStream& side : side_streams(design, c)) {
    signals += fmt::format(
        "  logic {0}_valid, {0}_ready;\n  logic [{1}:0] {0}_words[0:TOKENS-1];\n"
        "  integer {0}_sent = 0;\n  assign {0}_valid = {0}_sent < TOKENS;\n",
        side.name, side.width - 1);
    pins += fmt::format(
        "      .{0}_valid({0}_valid), .{0}_ready({0}_ready), "
        ".{0}({0}_words[{0}_sent < TOKENS ? {0}_sent : 0]),\n",
        side.name);
    axi_pins += fmt::format(
        "      .s_axis_{0}_tvalid({0}_valid), .s_axis_{0}_tready({0}_ready),\n"
        "      .s_axis_{0}_tdata({1}'({0}_words[{0}_sent < TOKENS ? {0}_sent : 0])),\n",
        side.name, axi_bits(side.width));
    reads += fmt::format("    $readmemh(\"{}\", {}_words);\n", side.file, side.name);
    moves += fmt::format("    if (!rst & {0}_valid & {0}_ready) {0}_sent <= {0}_sent + 1;\n", side.name);
  }
  std::string text = fmt::format(kBenchHead, fmt::arg("tokens", tokens), fmt::arg("width", width));
  text += signals;
  text += fmt::format(kDevices, fmt::arg("step", first_step), fmt::arg("pins", pins),
                      fmt::arg("axi_pins", axi_pins), fmt::arg("bits", axi_bits(width)),
                      fmt::arg("pass", design.shape.tokens()));
  return text + fmt::format(kBenchTail, fmt::arg("reads", reads), fmt::arg("moves", moves));
}

}  // namespace voxmelt::hwmodel
