// What a cell gives to an axis (docs/automaton.md, section 9).
module proof (
    input logic clk,
    input logic [49:0] stored,
    input logic [7:0] pattern,
    input logic [511:0] shares,
    input logic eight
);
  logic [15:0] flow5, part5;
  gift_unit dut (
      .clk(clk), .move(1'b1), .stored(stored), .pattern(pattern), .shares(shares), .eight(eight), .flow5(flow5),
      .part5(part5));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic eight1;
  past #(.WIDTH(1), .N(1)) stays (.clk(clk), .d(eight), .q(eight1));
  always_comb if (age != 8'd0) assume (eight == eight1);

  // A share of the amount, and as much of the energy, at most a fifth or a quarter of the greatest amount.
  wire [15:0] share = shares[{stored[49:45], 4'd0}+:16];
  wire [15:0] most = eight ? 16'd13107 : 16'd16384, cap = eight ? 16'd4096 : 16'd8192;
  always_comb assume (share <= most);  // section 14
  logic signed [34:0] amount_part, energy_part, amount5, energy5;
  logic [15:0] share1;
  logic [49:0] word1;
  past #(.WIDTH(66), .N(1)) operands (.clk(clk), .d({share, stored}), .q({share1, word1}));
  assign amount_part = 35'($signed({2'b0, word1[17:2]}) * $signed({1'b0, 1'b0, share1}));
  assign energy_part = 35'($signed({2'b0, word1[33:18]}) * $signed({1'b0, 1'b0, share1}));
  past #(.WIDTH(70), .N(4)) parts (.clk(clk), .d({amount_part, energy_part}), .q({amount5, energy5}));
  always_comb if (age == 8'd5) begin
    share_as_the_page: assert (flow5 == (amount5[31:16] < cap ? amount5[31:16] : cap));
    energy_as_the_page: assert (part5 == (energy5[31:16] < cap ? energy5[31:16] : cap));
  end

endmodule
