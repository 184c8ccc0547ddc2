// The least amounts of a neighbour that gets nothing from a cell, towards its axes and its diagonals
// (docs/automaton.md, section 9). Nothing is lower than 0.
module limit_unit (
    input  logic         clk,
    input  logic         move,
    input  logic [49:0]  stored,         // a set cell has the state of air and holds something
    input  logic         air_below,
    input  logic [511:0] shares,         // by temperature, 32 of them
    input  logic         eight,          // neighbours
    input  logic         support,
    input  logic         downhill,
    input  logic         gives_shares,   // not those of a table
    input  logic [15:0]  threshold,
    input  logic [15:0]  margin,         // these two towards an axis
    input  logic [15:0]  slump,
    input  logic [19:0]  margin_diagonal,
    input  logic [19:0]  slump_diagonal,
    output logic [15:0]  axis,           // 7 moves later
    output logic [15:0]  diagonal
);
  wire [15:0] amount = stored[17:2], energy = stored[33:18], heat = stored[49:34];
  wire stands = (stored[1:0] == voxmelt_pkg::LIQUID) & ~(support & air_below);
  wire energetic = energy > threshold;
  wire yields = stands & (energetic | (slump != 16'd0));

  logic [15:0] amount1, share1, amount5, amount6, given5;
  logic yields1, energetic1, yields5, energetic5, yields6;
  logic signed [34:0] part4;
  logic [19:0] axis6, diagonal6;
  product times_share (.clk(clk), .en(move), .a($signed({2'b0, amount1})), .b({1'b0, share1}), .p(part4));
  delay #(.WIDTH(18), .N(4)) waits (
      .clk(clk), .en(move), .d({yields1, energetic1, amount1}), .q({yields5, energetic5, amount5}));
  wire [15:0] cap = eight ? 16'd4096 : 16'd8192, most = eight ? 16'd45056 : 16'd32768;
  wire [15:0] slope5 = energetic5 ? margin : slump;
  wire [19:0] slope = 20'(slope5), slope_diagonal = energetic5 ? margin_diagonal : slump_diagonal;
  wire [19:0] over_axis = 20'(amount6) - axis6, over_diagonal = 20'(amount6) - diagonal6;

  always_ff @(posedge clk)
    if (move) begin
      amount1 <= amount;
      share1 <= shares[{heat[15:11], 4'd0}+:16];
      yields1 <= yields;
      energetic1 <= energetic;

      given5 <= ~gives_shares ? 16'd0 : part4[31:16] < cap ? part4[31:16] : cap;

      amount6 <= amount5;
      yields6 <= yields5;
      axis6 <= 20'(given5) > slope ? 20'(given5) : slope;
      diagonal6 <= 20'(given5) > slope_diagonal ? 20'(given5) : slope_diagonal;

      axis <= ~yields6 ? 16'd0 : ~downhill ? most : 20'(amount6) <= axis6 ? 16'd0
            : over_axis[15:0] < most ? over_axis[15:0] : most;
      diagonal <= ~yields6 ? 16'd0 : ~downhill ? most : 20'(amount6) <= diagonal6 ? 16'd0
                : over_diagonal[15:0] < most ? over_diagonal[15:0] : most;
    end
endmodule
