// The stage gravity: P lanes behind ready and valid. Tokens come column by column, the lowest first. Heat that
// climbs in one lane holds all of them.
module gravity_stage #(
    parameter P = 1
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
    input  logic [P-1:0]        in_runs,    // viscous law: which of the cells are in a run
    input  logic                paper,      // the law
    input  logic                hot,
    input  logic                printed,
    input  logic [16:0]         factor,
    input  logic [16:0]         wall_factor,
    input  logic [15:0]         minimum,
    input  logic [15:0]         hang,
    input  logic [18:0]         beta,
    output logic                holds        // a serial divider works
);
  logic [P-1:0] works;
  assign holds = |works;
  logic move, here, overlaps;
  voxmelt_pkg::place_t came, left;
  logic [31:0] step_came, step_left;
  logic [23:0] fill;
  logic drained;
  stage_control control (
      .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid),
      .out_ready(out_ready), .hold(holds), .follows(follows), .step(step), .last(last), .lag(lag),
      .move(move), .here(here), .overlaps(overlaps), .came(came), .left(left), .step_came(step_came),
      .step_left(step_left), .fill(fill), .drained(drained));

  logic [15:0] dither, dither13, dither18;
  dither_unit reverse (.step(step_came), .dither(dither));
  delay #(.WIDTH(16), .N(13)) of_loop (.clk(clk), .en(move), .d(dither), .q(dither13));
  delay #(.WIDTH(16), .N(5)) of_mixer (.clk(clk), .en(move), .d(dither13), .q(dither18));
  for (genvar lane = 0; lane < P; lane++) begin : lanes
    gravity_lane gravity (
        .clk(clk), .rst(rst), .move(move), .cell_in(in_cells[lane*67+:67]), .in_run(in_runs[lane]),
        .first(~here | (came.y == 12'd0)), .top(came.y == last.y), .live13(fill >= 24'd13), .dither13(dither13),
        .dither18(dither18), .paper(paper), .hot(hot), .printed(printed), .factor(factor),
        .wall_factor(wall_factor), .minimum(minimum), .hang(hang), .beta(beta), .works(works[lane]), .cell_out(out_cells[lane*67+:67]));
  end
endmodule
