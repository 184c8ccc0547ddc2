// A vent or a drain that acts on the cells of one lane (docs/automaton.md, section 3).
module opening_lane #(
    parameter VENT = 1
) (
    input  logic        clk,
    input  logic        move,
    input  logic [49:0] stored,
    input  logic        covers,       // it is open, and has this cell
    input  logic [15:0] rate,
    input  logic [15:0] temperature,
    input  logic [12:0] energy,       // per ONE of amount
    input  logic        hot,
    input  logic [15:0] dither4,      // of the step of the cell, so many moves later
    output logic [49:0] treated       // 25 moves later
);
  wire [15:0] amount = stored[17:2];
  wire acts = covers & ~stored[1];
  if (VENT != 0) begin : vent
    wire [15:0] space = voxmelt_pkg::AMAX - amount;
    wire [15:0] added = ~acts ? 16'd0 : rate < space ? rate : space;
    logic signed [34:0] before3, added3, energy3;
    logic [31:0] content4;
    logic [49:0] word4, word24;
    logic [15:0] added4, amount4, mixed24;
    logic mixes24;
    product content_before (
        .clk(clk), .en(move), .a($signed({2'b0, amount})), .b({1'b0, stored[49:34]}), .p(before3));
    product content_added (
        .clk(clk), .en(move), .a($signed({2'b0, added})), .b({1'b0, temperature}), .p(added3));
    product energy_added (.clk(clk), .en(move), .a($signed({2'b0, added})), .b({4'd0, energy}), .p(energy3));
    delay #(.WIDTH(66), .N(4)) waits_for_content (.clk(clk), .en(move), .d({added, stored}), .q({added4, word4}));
    logic [15:0] gained4;
    assign amount4 = word4[17:2] + added4;
    mixer mixture (
        .clk(clk), .en(move), .content(content4), .amount(amount4), .dither(dither4), .heat(mixed24));
    wire [49:0] vented4 = {word4[49:34], word4[33:18] + gained4, amount4, word4[1:0]};
    delay #(.WIDTH(51), .N(20)) waits (
        .clk(clk), .en(move), .d({hot & (added4 != 16'd0), vented4}), .q({mixes24, word24}));
    always_ff @(posedge clk)
      if (move) begin
        content4 <= before3[31:0] + added3[31:0];
        gained4 <= energy3[27:12];
        treated <= {mixes24 ? mixed24 : word24[49:34], word24[33:0]};
      end
  end else begin : drain
    logic [49:0] word1, word2;
    logic [15:0] taken1, left2;
    logic acts1, acts2;
    wire [15:0] held2 = word2[33:18];
    wire [15:0] kept2 = ~acts2 | (held2 < left2) ? held2 : left2;
    delay #(.WIDTH(50), .N(23)) waits (
        .clk(clk), .en(move), .d({word2[49:34], kept2, left2, word2[1:0]}), .q(treated));
    always_ff @(posedge clk)
      if (move) begin
        acts1 <= acts;
        acts2 <= acts1;
        taken1 <= ~acts ? 16'd0 : rate < amount ? rate : amount;
        left2 <= word1[17:2] - taken1;
        word1 <= stored;
        word2 <= word1;
      end
  end
endmodule
