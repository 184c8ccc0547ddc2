// Finishes a cell that has got all that it will get: friction of its ground, and the heat of the mixture
// (docs/automaton.md, section 9). In the reading `printed` friction acted on the gifts.
module finish_unit #(
    parameter PRINTED = 1
) (
    input  logic        clk,
    input  logic        move,
    input  logic [49:0] stored,
    input  logic [1:0]  footing,       // 0 liquid, 1 solid, 2 floor
    input  logic [15:0] left_amount,
    input  logic [15:0] left_energy,
    input  logic [15:0] amount_in,
    input  logic [15:0] energy_in,
    input  logic [31:0] content_in,
    input  logic [15:0] dither3,       // of the step of the cell, so many moves later
    input  logic [15:0] dither4,
    input  logic        hot,
    input  logic        printed,
    input  logic [47:0] alpha,
    output logic [49:0] finished       // 25 moves later
);
  logic [15:0] alpha0, old1, amount1, amount4, amount24, left4, gained3, gained4, energy5, energy24;
  logic [15:0] old_heat24, old_energy24, mixed24;
  logic [31:0] content3, content4;
  logic blocked1, mixes1, blocked24, mixes24;
  logic [1:0] state1, state24;
  logic signed [34:0] rubbed3, kept3;
  assign alpha0 = footing == 2'd0 ? alpha[15:0] : footing == 2'd1 ? alpha[31:16] : alpha[47:32];
  product friction (.clk(clk), .en(move), .a($signed({2'b0, energy_in})), .b({1'b0, alpha0}), .p(rubbed3));
  product kept (.clk(clk), .en(move), .a($signed({2'b0, left_amount})), .b({1'b0, stored[49:34]}), .p(kept3));
  delay #(.WIDTH(32), .N(3)) contents (.clk(clk), .en(move), .d(content_in), .q(content3));
  delay #(.WIDTH(16), .N(4)) lefts (.clk(clk), .en(move), .d(left_energy), .q(left4));
  delay #(.WIDTH(16), .N(3)) amounts (.clk(clk), .en(move), .d(amount1), .q(amount4));
  if (PRINTED != 0) begin : glides
    logic [15:0] energy3;
    delay #(.WIDTH(16), .N(3)) unrubbed (.clk(clk), .en(move), .d(energy_in), .q(energy3));
    assign gained3 = printed ? energy3 : rounded3[31:16];
  end else begin : rubs
    assign gained3 = rounded3[31:16];
  end
  mixer mixture (
      .clk(clk), .en(move), .content(content4), .amount(amount4), .dither(dither4), .heat(mixed24));
  delay #(.WIDTH(36), .N(23)) waits (
      .clk(clk), .en(move), .d({blocked1, mixes1, state1, old1, amount1}),
      .q({blocked24, mixes24, state24, old_heat24, amount24}));
  delay #(.WIDTH(16), .N(24)) energies (.clk(clk), .en(move), .d(stored[33:18]), .q(old_energy24));
  delay #(.WIDTH(16), .N(19)) new_energies (.clk(clk), .en(move), .d(energy5), .q(energy24));
  wire [34:0] rounded3 = rubbed3 + 35'(dither3);
  wire [16:0] gained = 17'(left4) + 17'(gained4);
  wire [15:0] held24 = blocked24 ? old_energy24 : energy24;
  wire empty24 = ~blocked24 & (amount24 == 16'd0);
  always_ff @(posedge clk)
    if (move) begin
      amount1 <= stored[1] ? stored[17:2] : left_amount + amount_in;
      blocked1 <= stored[1];
      mixes1 <= hot & ~stored[1];  // what took nothing mixes to its own heat
      state1 <= stored[1:0];
      old1 <= stored[49:34];
      content4 <= kept3[31:0] + content3;
      gained4 <= gained3;
      energy5 <= gained > 17'(amount4) ? amount4 : gained[15:0];
      finished <= {empty24 ? 16'd0 : mixes24 ? mixed24 : old_heat24, empty24 ? 16'd0 : held24, amount24,
                   blocked24 ? state24 : empty24 ? voxmelt_pkg::AIR : voxmelt_pkg::LIQUID};
    end
endmodule
