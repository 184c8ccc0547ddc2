// The stage fall: pieces that fall turn round with the cell below them (docs/automaton.md, section 15). A token
// comes with a bit for each of its cells. As long as the next cell up falls, it passes the held one.
module fall_stage #(
    parameter P = 1,
    parameter HOT = 1
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
    input  logic [P-1:0]        falls
);
  localparam CELL = HOT != 0 ? 50 : 34;
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

  logic [P*CELL-1:0] held, leaves;
  for (genvar lane = 0; lane < P; lane++) begin : lanes
    logic [49:0] stored;
    stored_of unpack (.cell_in(in_cells[lane*67+:67]), .stored(stored));
    wire passes = here & falls[lane];
    always_ff @(posedge clk)
      if (move) begin
        leaves[lane*CELL+:CELL] <= passes ? stored[CELL-1:0] : held[lane*CELL+:CELL];
        if (~passes) held[lane*CELL+:CELL] <= stored[CELL-1:0];
      end
    cell_of pack (
        .stored(50'(leaves[lane*CELL+:CELL])), .exposed_axes(2'd0), .pattern(8'd0), .beside_wall(1'b0),
        .touches(1'b0), .is_set(1'b0), .cell_out(out_cells[lane*67+:67]));
  end
endmodule
