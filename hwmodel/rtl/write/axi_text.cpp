#include <fmt/format.h>

#include <string>
#include <vector>

#include "hwmodel/rtl/write/pipeline_text.h"

namespace voxmelt::hwmodel {
namespace {

constexpr const char* kHead =
    R"(// The pipeline behind AXI4-Stream: a token is a beat, whose data is filled up to bytes with zeros. TLAST ends a
// pass. `first_step` and `follows` are registers of whoever drives it.
module axi_pipeline (
    input  logic aclk,
    input  logic aresetn,
    input  logic [31:0] first_step,  // of the first pass
    input  logic follows,            // a pass comes behind the present one, without a gap
)";

constexpr const char* kInput =
    R"(    input  logic s_axis_{0}_tvalid,
    output logic s_axis_{0}_tready,
    input  logic [{1}:0] s_axis_{0}_tdata,
)";

constexpr const char* kTail =
    R"(    output logic m_axis_cells_tvalid,
    input  logic m_axis_cells_tready,
    output logic [{last_bit}:0] m_axis_cells_tdata,
    output logic m_axis_cells_tlast
);
  localparam TOKENS = {tokens};  // of a pass
  logic rst, in_ready, out_valid;
{signals}  logic [31:0] left;  // tokens of the pass that leave behind the present one
  logic [{width}-1:0] out_cells;
  assign s_axis_cells_tready = in_ready & ~rst;
  assign m_axis_cells_tvalid = out_valid & ~rst;
  wire leaves = m_axis_cells_tvalid & m_axis_cells_tready;
  assign m_axis_cells_tdata = {bytes}'(out_cells);
  assign m_axis_cells_tlast = left == 32'd0;
  always_ff @(posedge aclk) begin
    rst <= ~aresetn;
    if (rst) left <= TOKENS - 32'd1;
    else if (leaves) left <= left == 32'd0 ? TOKENS - 32'd1 : left - 32'd1;
  end
  pipeline device (
      .clk(aclk), .rst(rst), .first_step(first_step), .follows(follows),
      .in_valid(s_axis_cells_tvalid & ~rst), .in_ready(in_ready), .in_cells(s_axis_cells_tdata[{width}-1:0]),
{pins}      .out_valid(out_valid), .out_ready(m_axis_cells_tready & ~rst), .out_cells(out_cells));
endmodule
)";

constexpr const char* kReady =
    R"(  logic {0}_ready;
  assign s_axis_{0}_tready = {0}_ready & ~rst;
)";

constexpr const char* kPin =
    R"(      .{0}_valid(s_axis_{0}_tvalid & ~rst), .{0}_ready({0}_ready), .{0}(s_axis_{0}_tdata[{1}:0]),
)";

}  // namespace

std::vector<SideStream> side_streams(const Design& design, const Configuration& c) {
  std::vector<SideStream> streams;
  for (int t = 0; design.hot() && design.parameters.heat.radiation && t < c.cascade; ++t)
    streams.push_back({fmt::format("feed{}", t), fmt::format("feed_{}.hex", t), 16 * c.lanes});
  if (design.parameters.pieces.fall) streams.push_back({"falls", "falls.hex", c.lanes});
  return streams;
}

int axi_bits(int width) { return (width + 7) / 8 * 8; }

std::string axi_text(const Design& design, const Configuration& c) {
  const int width = c.lanes * stored_bits(design);
  std::string text = kHead, pins, signals;
  text += fmt::format(kInput, "cells", axi_bits(width) - 1);
  for (const SideStream& side : side_streams(design, c)) {
    text += fmt::format(kInput, side.name, axi_bits(side.width) - 1);
    signals += fmt::format(kReady, side.name);
    pins += fmt::format(kPin, side.name, side.width - 1);
  }
  return text + fmt::format(kTail, fmt::arg("last_bit", axi_bits(width) - 1), fmt::arg("width", width),
                            fmt::arg("bytes", axi_bits(width)), fmt::arg("tokens", design.shape.tokens()),
                            fmt::arg("signals", signals), fmt::arg("pins", pins));
}

}  // namespace voxmelt::hwmodel
