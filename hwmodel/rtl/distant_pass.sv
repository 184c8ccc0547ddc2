// The pass of heat across edges, or corners: of the stages of these names. A cell waits for those in its
// column and row, for the next plane, and for the row of that.
//
// A word of the line is {touches, beside_wall, exposed axes, temperature, heat, energy, amount, state}.
module distant_pass #(
    parameter P = 1,
    parameter CORNERS = 0,
    parameter MATERIALS = 0,
    parameter AXES = 1,
    parameter WALL = 1,
    parameter TOUCHES = 1,
    parameter ENERGY = 16,
    parameter DEPTH_EAST = 4096,   // of the memories: the longest delay, less one
    parameter DEPTH_NORTH = 32768,
    parameter DEPTH_SOUTH_EAST = 4096
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
    input  logic [23:0]         east,         // length of the memory towards the east
    input  logic [23:0]         north,        // from there to the north
    input  logic [23:0]         south_east,   // and from there to the east again
    input  logic                several,      // materials there are; else the first row of each table counts
    input  logic [(49<<MATERIALS)-1:0] curves,
    input  logic [15:0]         top,
    input  logic [(16<<(2*MATERIALS))-1:0] weights
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

  logic here0, here1, west1, below1, south1;  // what is known of the token in register 1
  logic [2:0] known0;
  logic [15:0] dither, dither0, dither5;
  dither_unit reverse (.step(step_came), .dither(dither));
  curve_wait #(.WIDTH(20), .MATERIALS(MATERIALS)) for_temperature (
      .clk(clk), .en(move), .several(several),
      .d({dither, here & (came.block != 12'd0), here & (came.y != 12'd0), here & (came.plane != 12'd0), here}),
      .q({dither0, known0, here0}));
  always_ff @(posedge clk) if (move) {west1, below1, south1, here1} <= {known0, here0};
  delay #(.WIDTH(16), .N(5)) dithers (.clk(clk), .en(move), .d(dither0), .q(dither5));

  // The words of the four columns of a window, and those one move later.
  logic [P*70-1:0] words1, words2, wests1, wests2, souths1, souths2, corners1, corners2;
  logic [P*70-1:0] to_east, to_north, to_south_east, leaving;
  heat_memory #(.P(P), .MOST(2), .AXES(2 * AXES), .WALL(WALL), .TOUCHES(TOUCHES), .ENERGY(ENERGY),
                .DEPTH(DEPTH_EAST)) columns (
      .clk(clk), .rst(rst), .en(move), .delay(east), .d(to_east), .q(wests1));
  heat_memory #(.P(P), .MOST(2), .AXES(2 * AXES), .WALL(WALL), .TOUCHES(TOUCHES), .ENERGY(ENERGY),
                .DEPTH(DEPTH_NORTH)) planes (
      .clk(clk), .rst(rst), .en(move), .delay(north), .d(to_north), .q(souths1));
  heat_memory #(.P(P), .MOST(2), .AXES(2 * AXES), .WALL(WALL), .TOUCHES(TOUCHES), .ENERGY(ENERGY),
                .DEPTH(DEPTH_SOUTH_EAST)) south_columns (
      .clk(clk), .rst(rst), .en(move), .delay(south_east), .d(to_south_east), .q(corners1));

  function automatic [21:0] seen(input [69:0] word);
    seen = {word[1] ^ word[0], word[1:0] == voxmelt_pkg::SOLID ? word[21:18] : 4'd0, (word[1] ^ word[0]) | (word[1] & word[0] & (word[49:34] != 16'd0)), word[65:50]};
  endfunction

  logic [P*16-1:0] here7, west7, below7, west_below7, south7, south_west7, south_below7, south_west_below7;
  for (genvar lane = 0; lane < P; lane++) begin : lanes
    localparam [0:0] LAST = lane == P - 1;  // its eastern cell is in another token
    localparam WEST = (lane + P - 1) % P, EAST = (lane + 1) % P;
    logic [49:0] stored, stored0;
    logic [3:0] material, bands0;
    logic [15:0] temperature;
    stored_of unpack (.cell_in(in_cells[lane*67+:67]), .stored(stored));
    material_of number (.stored(stored), .material(material));
    curve_unit #(.MATERIALS(MATERIALS)) curve (
        .clk(clk), .en(move), .heat(stored[49:34]), .material(material), .several(several), .curves(curves),
        .top(top), .temperature(temperature));
    curve_wait #(.WIDTH(54), .MATERIALS(MATERIALS)) waits_for_it (
        .clk(clk), .en(move), .several(several),
        .d({in_cells[lane*67+64+:2], in_cells[lane*67+54+:2], stored}), .q({bands0, stored0}));
    always_ff @(posedge clk)
      if (move) words1[lane*70+:70] <= here0 ? {bands0, temperature, stored0} : {20'd0, voxmelt_pkg::BORDER};

    distant_lane #(.CORNERS(CORNERS), .MATERIALS(MATERIALS)) pairs (
        .clk(clk), .move(move), .west_there(lane == 0 ? west1 : here1), .below_there(below1),
        .south_there(south1), .here(seen(words1[lane*70+:70])), .below(seen(words2[lane*70+:70])),
        .west(seen(lane == 0 ? wests1[WEST*70+:70] : words1[WEST*70+:70])),
        .west_below(seen(lane == 0 ? wests2[WEST*70+:70] : words2[WEST*70+:70])),
        .south(seen(souths1[lane*70+:70])), .south_below(seen(souths2[lane*70+:70])),
        .south_west(seen(lane == 0 ? corners1[WEST*70+:70] : souths1[WEST*70+:70])),
        .south_west_below(seen(lane == 0 ? corners2[WEST*70+:70] : souths2[WEST*70+:70])),
        .weights(weights), .dither5(dither5), .here7(here7[lane*16+:16]), .west7(west7[lane*16+:16]),
        .below7(below7[lane*16+:16]), .west_below7(west_below7[lane*16+:16]), .south7(south7[lane*16+:16]),
        .south_west7(south_west7[lane*16+:16]), .south_below7(south_below7[lane*16+:16]),
        .south_west_below7(south_west_below7[lane*16+:16]));

    // Where it is in the window of its eastern neighbour, too, if that came with it.
    distant_wait now (
        .clk(clk), .move(move), .word(words1[lane*70+:70]),
        .gets7(here7[lane*16+:16] + (LAST ? 16'd0 : west7[EAST*16+:16])),
        .gets8(below7[lane*16+:16] + (LAST ? 16'd0 : west_below7[EAST*16+:16])),
        .word2(words2[lane*70+:70]), .word9(to_east[lane*70+:70]));
    distant_wait in_the_west (
        .clk(clk), .move(move), .word(wests1[lane*70+:70]), .gets7(LAST ? west7[0+:16] : 16'd0),
        .gets8(LAST ? west_below7[0+:16] : 16'd0), .word2(wests2[lane*70+:70]),
        .word9(to_north[lane*70+:70]));
    distant_wait in_the_south (
        .clk(clk), .move(move), .word(souths1[lane*70+:70]),
        .gets7(south7[lane*16+:16] + (LAST ? 16'd0 : south_west7[EAST*16+:16])),
        .gets8(south_below7[lane*16+:16] + (LAST ? 16'd0 : south_west_below7[EAST*16+:16])),
        .word2(souths2[lane*70+:70]), .word9(to_south_east[lane*70+:70]));
    distant_wait in_the_south_west (
        .clk(clk), .move(move), .word(corners1[lane*70+:70]), .gets7(LAST ? south_west7[0+:16] : 16'd0),
        .gets8(LAST ? south_west_below7[0+:16] : 16'd0), .word2(corners2[lane*70+:70]),
        .word9(leaving[lane*70+:70]));

    wire [69:0] word = leaving[lane*70+:70];
    cell_of pack (
        .stored(word[49:0]), .exposed_axes(word[67:66]), .pattern(8'd0), .beside_wall(word[68]),
        .touches(word[69]), .is_set(1'b0), .cell_out(out_cells[lane*67+:67]));
  end
endmodule
