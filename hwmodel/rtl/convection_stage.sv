// The stage convection: P lanes behind ready and valid.
module convection_stage #(
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
    input  logic [15:0]         melting_point,
    input  logic [15:0]         latent_heat,
    input  logic [15:0]         top,          // no temperature is beyond it
    input  logic [15:0]         weight
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

  wire on_floor = ~here | (came.y == 12'd0);
  logic [15:0] dither, dither5;
  dither_unit reverse (.step(step_came), .dither(dither));
  delay #(.WIDTH(16), .N(5)) dithers (.clk(clk), .en(move), .d(dither), .q(dither5));
  for (genvar lane = 0; lane < P; lane++) begin : lanes
    convection_lane convection (
        .clk(clk), .move(move), .cell_in(in_cells[lane*67+:67]), .on_floor(on_floor), .dither5(dither5),
        .melting_point(melting_point), .latent_heat(latent_heat), .top(top), .weight(weight),
        .cell_out(out_cells[lane*67+:67]));
  end
endmodule
