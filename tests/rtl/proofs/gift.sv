// What a cell gives to an axis (docs/automaton.md, section 9).
module proof (
    input logic clk,
    input logic [49:0] stored,
    input logic [7:0] pattern,
    input logic [511:0] shares,
    input logic by_table,
    input logic [1023:0] table_shares,
    input logic eight
);
  logic [63:0] flow5, part5;
  gift_unit dut (
      .clk(clk), .move(1'b1), .stored(stored), .pattern(pattern), .footing(2'd0), .shares(shares), .by_table(by_table),
      .table_shares(table_shares), .printed(1'b0), .alpha(48'd0), .eight(eight), .flow5(flow5), .part5(part5));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic eight1;
  past #(.WIDTH(1), .N(1)) stays (.clk(clk), .d(eight), .q(eight1));
  always_comb if (age != 8'd0) assume (eight == eight1);
  wire [15:0] cap = eight ? 16'd4096 : 16'd8192;

  // A share of the amount, and as much of the energy, at most a fifth or a quarter of the greatest amount.
  for (genvar way = 0; way < 4; way++) begin : ways
    wire [15:0] share = by_table ? table_shares[{pattern[3:0], 2'(way), 4'd0}+:16] : shares[{stored[49:45], 4'd0}+:16];
    logic signed [34:0] amount_part, energy_part, amount5, energy5;
    logic [15:0] share1;
    logic [49:0] word1;
    past #(.WIDTH(66), .N(1)) operands (.clk(clk), .d({share, stored}), .q({share1, word1}));
    assign amount_part = 35'($signed({2'b0, word1[17:2]}) * $signed({1'b0, 1'b0, share1}));
    assign energy_part = 35'($signed({2'b0, word1[33:18]}) * $signed({1'b0, 1'b0, share1}));
    past #(.WIDTH(70), .N(4)) parts (.clk(clk), .d({amount_part, energy_part}), .q({amount5, energy5}));
    wire share_right = flow5[way*16+:16] == (amount5[31:16] < cap ? amount5[31:16] : cap);
    wire energy_right = part5[way*16+:16] == (energy5[31:16] < cap ? energy5[31:16] : cap);
  end
  always_comb if (age == 8'd5) begin
    share_as_the_page: assert (ways[0].share_right & ways[1].share_right & ways[2].share_right & ways[3].share_right);
    energy_as_the_page: assert (ways[0].energy_right & ways[1].energy_right & ways[2].energy_right & ways[3].energy_right);
  end

endmodule
