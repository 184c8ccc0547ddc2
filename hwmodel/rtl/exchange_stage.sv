// The stage exchange: P lanes behind ready and valid. A token and its irradiance come together.
module exchange_stage #(
    parameter P = 1,
    parameter MATERIALS = 0,  // bits of their numbers; 0: there is one
    parameter HEIGHT = 4096,  // of a column, at most
    parameter AIR = ""        // a file of the air's temperatures, for $readmemh; otherwise the ports write them
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
    input  logic [P*16-1:0]     irradiance,
    input  logic                table_write,    // the table of the air's temperatures is filled once
    input  logic [11:0]         table_address,
    input  logic [15:0]         table_data,
    input  logic                several,      // materials there are; else the first row of each table counts
    input  logic [(49<<MATERIALS)-1:0] curves,
    input  logic [15:0]         top,
    input  logic [(48<<MATERIALS)-1:0] air_weights,
    input  logic [47:0]         glow_weights,
    input  logic [15:0]         sky
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

  logic [15:0] air[0:HEIGHT-1];
  logic [15:0] ambient1, ambient2, ambient3;
  localparam ADDRESS = HEIGHT > 1 ? $clog2(HEIGHT) : 1;
  initial if (AIR != "") $readmemh(AIR, air);
  always_ff @(posedge clk) begin
    if (table_write) air[table_address[ADDRESS-1:0]] <= table_data;
    if (move) ambient1 <= air[came.y[ADDRESS-1:0]];
  end
  delay #(.WIDTH(16), .N(2)) ambients (.clk(clk), .en(move), .d(ambient1), .q(ambient2));
  curve_wait #(.WIDTH(16), .MATERIALS(MATERIALS)) ambients_later (
      .clk(clk), .en(move), .several(several), .d(ambient2), .q(ambient3));

  logic [15:0] dither, dither1, dither4, dither7, dither17, dither20;
  dither_unit reverse (.step(step_came), .dither(dither));
  delay #(.WIDTH(16), .N(1)) at_radiation (.clk(clk), .en(move), .d(dither), .q(dither1));
  delay #(.WIDTH(16), .N(6)) at_air (.clk(clk), .en(move), .d(dither1), .q(dither4));
  curve_wait #(.WIDTH(16), .MATERIALS(MATERIALS)) at_air_later (
      .clk(clk), .en(move), .several(several), .d(dither4), .q(dither7));
  delay #(.WIDTH(16), .N(13)) at_glow (.clk(clk), .en(move), .d(dither7), .q(dither17));
  curve_wait #(.WIDTH(16), .MATERIALS(MATERIALS)) at_glow_later (
      .clk(clk), .en(move), .several(several), .d(dither17), .q(dither20));

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    exchange_lane #(.MATERIALS(MATERIALS)) exchange (
        .clk(clk), .move(move), .cell_in(in_cells[lane*67+:67]), .received(irradiance[lane*16+:16]),
        .dither1(dither1), .dither7(dither7), .dither20(dither20), .ambient3(ambient3),
        .several(several), .curves(curves), .top(top), .air_weights(air_weights),
        .glow_weights(glow_weights), .sky(sky), .cell_out(out_cells[lane*67+:67]));
  end
endmodule
