// The stage gravity: P lanes behind ready and valid. Tokens come column by column, the lowest first.
//
// A cell leaves when the one above it comes. Nothing is above the last cell of a column, so a slot without a
// cell pushes it out if no token comes. So the stage empties itself at the end of a pass, and at any stall.
module gravity_stage #(
    parameter P = 1
) (
    input  logic            clk,
    input  logic            rst,
    input  logic            in_valid,
    output logic            in_ready,
    input  logic [P*35-1:0] in_cells,   // voxmelt_pkg::falling_t, lane 0 lowest
    output logic            out_valid,
    input  logic            out_ready,
    output logic [P*34-1:0] out_cells,  // voxmelt_pkg::cell_t
    // These stay as they are while tokens are under way.
    input  logic [11:0]     top,        // height of the last cell of a column
    input  logic [16:0]     factor,
    input  logic [16:0]     wall_factor,
    input  logic [15:0]     minimum,
    input  logic [18:0]     beta
);
  localparam LATENCY = 10;

  // A bit for each register that a slot passes. `gives` tells if a cell leaves with it.
  logic [LATENCY:1] valid;
  logic [3:1] first;        // up to the loop of amounts
  logic [6:1] ghost;        // up to the loop of energy
  logic [LATENCY:7] gives;  // from there on
  logic [11:0] y;
  logic pending;  // the last cell of a column waits
  logic below;    // a cell waits in the loop of energy

  wire en = ~out_valid | out_ready;
  assign in_ready = en;
  assign out_valid = valid[LATENCY] & gives[LATENCY];

  always_ff @(posedge clk)
    if (rst) begin
      valid <= '0;
      y <= 12'd0;
      pending <= 1'b0;
      below <= 1'b0;
    end else if (en) begin
      valid <= {valid[LATENCY-1:1], in_valid | pending};
      pending <= in_valid & (y == top);
      if (in_valid) y <= y == top ? 12'd0 : y + 12'd1;
      if (valid[6]) below <= ~ghost[6];
    end

  always_ff @(posedge clk)
    if (en) begin
      first <= {first[2:1], y == 12'd0};
      ghost <= {ghost[5:1], ~in_valid};
      gives <= {gives[LATENCY-1:7], below};
    end

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    gravity_lane gravity (
        .clk(clk),
        .en(en),
        .v3(valid[3]),
        .f3(first[3]),
        .v6(valid[6]),
        .q(in_cells[lane*35+:35]),
        .factor(factor),
        .wall_factor(wall_factor),
        .minimum(minimum),
        .beta(beta),
        .p(out_cells[lane*34+:34])
    );
  end
endmodule
