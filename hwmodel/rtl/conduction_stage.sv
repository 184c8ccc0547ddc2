// The stage conduction: heat through faces, exposed axes, and which cells stand beside something blocked.
module conduction_stage #(
    parameter P = 1,
    parameter MATERIALS = 0,       // bits of their numbers; 0: there is one
    parameter AXES = 1,            // what is found of a cell, and the bits of its energy that matter
    parameter WALL = 1,
    parameter TOUCHES = 1,
    parameter ENERGY = 16,
    parameter DEPTH_EAST = 4096,   // of the memories: the longest delay, less one
    parameter DEPTH_NORTH = 32768
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
    input  logic [23:0]         north,        // and from there to the north
    input  logic                counts_axes,  // the air asks for them
    input  logic                finds_walls,
    input  logic                finds_touched,
    input  logic                several,      // materials there are; else the first row of each table counts
    input  logic [(49<<MATERIALS)-1:0] curves,
    input  logic [15:0]         top,
    input  logic [(16<<(2*MATERIALS))-1:0] weights  // of pairs, by both materials
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

  // What is known of the token in register 1. All waits for the temperature of what came.
  logic here0, here1, west1, below1, south1, side1, end1, last1;
  logic [15:0] dither, dither0, dither5;
  logic [5:0] known0;
  dither_unit reverse (.step(step_came), .dither(dither));
  curve_wait #(.WIDTH(23), .MATERIALS(MATERIALS)) for_temperature (
      .clk(clk), .en(move), .several(several),
      .d({dither, here & (came.block != 12'd0), here & (came.y != 12'd0), here & (came.plane != 12'd0),
          (came.plane == 12'd0) | (came.plane == last.plane), (came.y == 12'd0) | (came.y == last.y),
          came.block == last.block, here}),
      .q({dither0, known0, here0}));
  always_ff @(posedge clk) if (move) {west1, below1, south1, side1, end1, last1, here1} <= {known0, here0};
  wire first1 = ~west1;
  delay #(.WIDTH(16), .N(5)) dithers (.clk(clk), .en(move), .d(dither0), .q(dither5));

  logic [P*71-1:0] words1, words9, to_east, turned_east, to_north;
  logic [P*16-1:0] flows_west, flows_south;
  heat_memory #(.P(P), .AXES(3 * AXES), .WALL(WALL), .TOUCHES(TOUCHES), .ENERGY(ENERGY), .DEPTH(DEPTH_EAST)) columns (
      .clk(clk), .rst(rst), .en(move), .delay(east), .d(words9), .q(to_east));
  heat_memory #(.P(P), .AXES(3 * AXES), .WALL(WALL), .TOUCHES(TOUCHES), .ENERGY(ENERGY), .DEPTH(DEPTH_NORTH)) planes (
      .clk(clk), .rst(rst), .en(move), .delay(north), .d(turned_east), .q(to_north));

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    logic [49:0] stored, stored0;
    logic [3:0] material;
    logic [15:0] temperature;
    stored_of unpack (.cell_in(in_cells[lane*67+:67]), .stored(stored));
    material_of number (.stored(stored), .material(material));
    curve_unit #(.MATERIALS(MATERIALS)) curve (
        .clk(clk), .en(move), .heat(stored[49:34]), .material(material), .several(several), .curves(curves),
        .top(top), .temperature(temperature));
    curve_wait #(.WIDTH(50), .MATERIALS(MATERIALS)) waits_for_it (
        .clk(clk), .en(move), .several(several), .d(stored), .q(stored0));
    wire [70:0] word_in = here0 ? {5'd0, temperature, stored0} : {5'd0, 16'd0, voxmelt_pkg::BORDER};
    conduction_lane #(.MATERIALS(MATERIALS)) conduction (
        .clk(clk), .move(move), .word_in(word_in),
        .west_there(lane == 0 ? west1 : here1), .below_there(below1), .south_there(south1),
        .at_side(side1 | (lane == 0 ? first1 : 1'b0) | (lane == P - 1 ? last1 : 1'b0)), .at_end(end1),
        .west(lane == 0 ? to_east[(P-1)*71+:71] : words1[((lane+P-1)%P)*71+:71]),
        .south(to_north[lane*71+:71]),
        .east(words1[((lane+1)%P)*71+:71]), .east_there(lane == P - 1 ? 1'b0 : 1'b1),
        .east_flow6(flows_west[((lane+1)%P)*16+:16]),
        .weights(weights), .dither_x(dither5), .dither_y(dither5 + 16'd21845), .dither_z(dither5 + 16'd43690),
        .word1(words1[lane*71+:71]), .word9(words9[lane*71+:71]),
        .west_flow6(flows_west[lane*16+:16]), .south_flow6(flows_south[lane*16+:16]));

    if (lane == P - 1) begin : turns
      conduction_side_lane #(.EXPOSED(66)) side (
          .clk(clk), .move(move), .word(to_east[lane*71+:71]), .there(west1), .other1(words1[0+:71]),
          .flow6(flows_west[0+:16]), .turned(turned_east[lane*71+:71]));
    end else begin : waits
      delay #(.WIDTH(71), .N(5)) past (
          .clk(clk), .en(move), .d(to_east[lane*71+:71]), .q(turned_east[lane*71+:71]));
    end

    logic [70:0] turned, word;
    conduction_side_lane #(.EXPOSED(68)) back (
        .clk(clk), .move(move), .word(to_north[lane*71+:71]), .there(south1), .other1(words1[lane*71+:71]),
        .flow6(flows_south[lane*16+:16]), .turned(turned));
    always_ff @(posedge clk) if (move) word <= turned;
    wire [1:0] axes = 2'(word[66]) + 2'(word[67]) + 2'(word[68]);
    cell_of pack (
        .stored(word[49:0]), .exposed_axes(counts_axes ? axes : 2'd0), .pattern(8'd0),
        .beside_wall(finds_walls & word[69]), .touches(finds_touched & word[70]), .is_set(1'b0),
        .cell_out(out_cells[lane*67+:67]));
  end
endmodule
