// How the stage spread rounds: for the pairs of each axis, and for mixtures. Two passes at most are under way.
// A bit tells them apart. Passes that overlap have as many sub-steps.
module spread_passes (
    input  logic        clk,
    input  logic        rst,
    input  logic        move,
    input  logic        first,           // the first token of a pass comes
    input  logic [31:0] step,            // of that pass, as the three below
    input  logic [15:0] substep,
    input  logic [36:0] reciprocal,
    input  logic [39:0] turns,
    input  logic [11:0] y11,             // of the token at position 11
    input  logic        odd11,           // its pass
    input  logic        old_row11,       // w of lane 0 is of the pass before
    input  logic        old_plane11,     // s is
    input  logic        odd_finished,    // the pass of what is mixed
    output logic        odd_now,         // of the token that comes
    output logic [15:0] rounding_x,      // these are at position 16: s with sw,
    output logic [15:0] rounding_z,      // w with sw,
    output logic [15:0] rounding_up,     // q with sw,
    output logic [15:0] rounding_down,   // w with s
    output logic [15:0] finish_dither
);
  logic odd;
  logic [15:0] dither, of_substep;
  logic [31:0] even_pass, odd_pass;  // {dither of mixtures, dither of the step}
  logic [36:0] reciprocal_now;
  logic [39:0] turns_now;
  dither_unit reverse (.step(step), .dither(dither));
  dither_unit reverse_substep (.step(32'(substep)), .dither(of_substep));
  wire [15:0] mixes = dither + of_substep;
  assign odd_now = odd ^ first;
  always_ff @(posedge clk) begin
    if (rst) odd <= 1'b0;
    else if (move) odd <= odd_now;
    if (move & first & odd_now) odd_pass <= {mixes, dither};
    if (move & first & ~odd_now) even_pass <= {mixes, dither};
    if (move & first) begin
      reciprocal_now <= reciprocal;
      turns_now <= turns;
    end
  end
  assign finish_dither = odd_finished ? odd_pass[31:16] : even_pass[31:16];

  wire [15:0] dither11 = odd11 ? odd_pass[15:0] : even_pass[15:0];
  wire [15:0] row_dither11 = odd11 ^ old_row11 ? odd_pass[15:0] : even_pass[15:0];
  wire [15:0] plane_dither11 = odd11 ^ old_plane11 ? odd_pass[15:0] : even_pass[15:0];
  pair_dither #(.SHIFT(16'd0)) along_x (
      .clk(clk), .move(move), .y11(y11), .dither11(plane_dither11), .reciprocal11(reciprocal_now),
      .turn11(turns_now[9:0]), .rounding16(rounding_x));
  pair_dither #(.SHIFT(16'd16384)) along_z (
      .clk(clk), .move(move), .y11(y11), .dither11(row_dither11), .reciprocal11(reciprocal_now),
      .turn11(turns_now[19:10]), .rounding16(rounding_z));
  pair_dither #(.SHIFT(16'd32768)) upwards (
      .clk(clk), .move(move), .y11(y11), .dither11(dither11), .reciprocal11(reciprocal_now),
      .turn11(turns_now[29:20]), .rounding16(rounding_up));
  pair_dither #(.SHIFT(16'd49152)) downwards (
      .clk(clk), .move(move), .y11(y11), .dither11(dither11), .reciprocal11(reciprocal_now),
      .turn11(turns_now[39:30]), .rounding16(rounding_down));
endmodule
