// The stage walls: does one of the four sides of a cell stand blocked? It exists without heat (paper law).
//
// A cell waits for its east side, and then for its north side. Only lane P - 1 has its east in another token.
module walls_stage #(
    parameter P = 1,
    parameter HOT = 0,
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
    input  logic [23:0]         east,       // moves from a cell to its eastern neighbour, or any where it has none
    input  logic [23:0]         north       // from there to its northern one
);
  localparam WORD = HOT != 0 ? 51 : 35;  // {cell, beside_wall}
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

  wire has_west = here & (came.block != 12'd0);
  wire has_south = here & (came.plane != 12'd0);
  wire at_end = (came.plane == 12'd0) | (came.plane == last.plane);
  wire ends_row = came.block == last.block;
  logic [P*WORD-1:0] came_words, west_words, turned_words, south_words, left_words;
  line_memory #(.WIDTH(P * WORD), .DEPTH(DEPTH_EAST)) columns (
      .clk(clk), .rst(rst), .en(move), .delay(east), .d(came_words), .q(west_words));
  line_memory #(.WIDTH(P * WORD), .DEPTH(DEPTH_NORTH)) planes (
      .clk(clk), .rst(rst), .en(move), .delay(north), .d(turned_words), .q(south_words));

  wire [P-1:0] blocked;
  for (genvar lane = 0; lane < P; lane++) begin : lanes
    wire west = lane == 0 ? ~has_west | west_words[(P-1)*WORD+2] : blocked[(lane+P-1)%P];
    wire east_side = lane == P - 1 ? ends_row : blocked[(lane+1)%P];
    wire south = has_south & south_words[lane*WORD+2];
    wire [49:0] stored;
    stored_of unpack (.cell_in(in_cells[lane*67+:67]), .stored(stored));
    assign blocked[lane] = stored[1];
    assign came_words[lane*WORD+:WORD] = {stored[WORD-2:0], west | east_side | south | at_end};
    // The cell in lane 0 that comes is the east of lane P - 1 in the block before.
    wire turns = lane == P - 1 ? has_west & blocked[0] : 1'b0;
    assign turned_words[lane*WORD+:WORD] = west_words[lane*WORD+:WORD] | WORD'(turns);
    wire north_side = has_south & blocked[lane];
    always_ff @(posedge clk)
      if (move) left_words[lane*WORD+:WORD] <= south_words[lane*WORD+:WORD] | WORD'(north_side);
    cell_of pack (
        .stored(50'(left_words[lane*WORD+1+:WORD-1])), .exposed_axes(2'd0), .pattern(8'd0),
        .beside_wall(left_words[lane*WORD]), .touches(1'b0), .is_set(1'b0), .cell_out(out_cells[lane*67+:67]));
  end
endmodule
