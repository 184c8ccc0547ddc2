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
    input  logic [15:0] dither5,      // of the step of the cell, so many moves later
    output logic [49:0] treated       // 26 moves later
);
  wire [15:0] amount = stored[17:2];
  wire acts = covers & ~stored[1];
  if (VENT != 0) begin : vent
    wire [15:0] space = voxmelt_pkg::AMAX - amount;
    logic signed [34:0] before4, added4, energy4;
    logic [31:0] content5;
    logic [49:0] word1, word5, word25;
    logic [15:0] added1, added5, gained5, amount5, mixed25;
    logic mixes25;
    product content_before (
        .clk(clk), .en(move), .a($signed({2'b0, word1[17:2]})), .b({1'b0, word1[49:34]}), .p(before4));
    product content_added (
        .clk(clk), .en(move), .a($signed({2'b0, added1})), .b({1'b0, temperature}), .p(added4));
    product energy_added (.clk(clk), .en(move), .a($signed({2'b0, added1})), .b({4'd0, energy}), .p(energy4));
    delay #(.WIDTH(66), .N(4)) waits_for_content (.clk(clk), .en(move), .d({added1, word1}), .q({added5, word5}));
    assign amount5 = word5[17:2] + added5;
    mixer mixture (
        .clk(clk), .en(move), .content(content5), .amount(amount5), .dither(dither5), .heat(mixed25));
    wire [49:0] vented5 = {word5[49:34], word5[33:18] + gained5, amount5, word5[1:0]};
    delay #(.WIDTH(51), .N(20)) waits (
        .clk(clk), .en(move), .d({hot & (added5 != 16'd0), vented5}), .q({mixes25, word25}));
    always_ff @(posedge clk)
      if (move) begin
        added1 <= ~acts ? 16'd0 : rate < space ? rate : space;
        word1 <= stored;
        content5 <= before4[31:0] + added4[31:0];
        gained5 <= energy4[27:12];
        treated <= {mixes25 ? mixed25 : word25[49:34], word25[33:0]};
      end
  end else begin : drain
    logic [49:0] word1, word2;
    logic [15:0] taken1, left2;
    logic acts1, acts2;
    wire [15:0] held2 = word2[33:18];
    wire [15:0] kept2 = ~acts2 | (held2 < left2) ? held2 : left2;
    delay #(.WIDTH(50), .N(24)) waits (
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
