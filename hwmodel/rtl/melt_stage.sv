// The stage melt: P lanes behind ready and valid.
module melt_stage #(
    parameter P = 1,
    parameter MATERIALS = 0  // bits of their numbers; 0: there is one
) (
    input  logic                clk,
    input  logic                rst,
    input  logic                in_valid,
    output logic                in_ready,
    input  logic [P*67-1:0]     in_cells,   // voxmelt_pkg::cell_t, lane 0 lowest
    output logic                out_valid,
    input  logic                out_ready,
    output logic [P*67-1:0]     out_cells,
    input  logic                follows,
    input  logic [31:0]         step,
    input  voxmelt_pkg::place_t last,
    input  logic [23:0]         lag,
    input  logic                paper,          // the law
    input  logic [15:0]         freezes_below,
    input  logic [(33<<MATERIALS)-1:0] melting,  // of each material, see melt_lane.sv
    input  logic [15:0]         reheat
);
  logic move, here, overlaps;
  voxmelt_pkg::place_t came, left;
  logic [31:0] step_came, step_left;
  logic [23:0] fill;
  logic drained;
  stage_control control (
      .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid),
      .out_ready(out_ready), .hold(1'b0), .follows(follows), .step(step), .last(last), .lag(lag),
      .move(move), .here(here), .overlaps(overlaps), .came(came), .left(left), .step_came(step_came),
      .step_left(step_left), .fill(fill), .drained(drained));

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    melt_lane #(.MATERIALS(MATERIALS)) melt (
        .clk(clk), .move(move), .cell_in(in_cells[lane*67+:67]), .paper(paper), .freezes_below(freezes_below),
        .melting(melting), .reheat(reheat), .cell_out(out_cells[lane*67+:67]));
  end
endmodule
