// What a cell gives to each of its directions, and what it keeps (docs/automaton.md, section 9). A diagonal
// gets a quarter.
module gift_unit (
    input  logic         clk,
    input  logic         move,
    input  logic [49:0]  stored,
    input  logic [7:0]   pattern,
    input  logic [511:0] shares,      // by temperature, 32 of them
    input  logic         eight,
    output logic [13:0]  amount,      // to an axis; all of these 9 moves later
    output logic [13:0]  energy,
    output logic [29:0]  content,     // amount x heat
    output logic [27:0]  content_diagonal,
    output logic [15:0]  left_amount,
    output logic [15:0]  left_energy
);
  wire [15:0] cap = eight ? 16'd4096 : 16'd8192;
  logic [49:0] word1, word5;
  logic [7:0] pattern1, pattern5, pattern6;
  logic [15:0] share1, flow5, part5, heat6, held6, held_energy6, held7, held_energy7;
  logic [13:0] amount6, energy6, amount7, energy7, amount8, energy8;
  logic [15:0] axes7, axes_energy7, corners7, corners_energy7, left8, left_energy8;
  logic signed [34:0] part4, energy4, content9, content_diagonal9;
  product of_amount (.clk(clk), .en(move), .a($signed({2'b0, word1[17:2]})), .b({1'b0, share1}), .p(part4));
  product of_energy (.clk(clk), .en(move), .a($signed({2'b0, word1[33:18]})), .b({1'b0, share1}), .p(energy4));
  delay #(.WIDTH(58), .N(4)) waits (
      .clk(clk), .en(move), .d({pattern1, word1}), .q({pattern5, word5}));
  product of_heat (
      .clk(clk), .en(move), .a($signed({4'd0, amount6})), .b({1'b0, heat6}), .p(content9));
  product of_heat_diagonal (
      .clk(clk), .en(move), .a($signed({6'd0, amount6[13:2]})), .b({1'b0, heat6}), .p(content_diagonal9));
  assign content = content9[29:0];
  assign content_diagonal = content_diagonal9[27:0];

  function automatic [15:0] times(input [3:0] ways, input [13:0] one);
    times = (16'(one) & {16{ways[0]}}) + (16'(one) & {16{ways[1]}})
          + ((16'(one) & {16{ways[2]}}) + (16'(one) & {16{ways[3]}}));
  endfunction

  always_ff @(posedge clk)
    if (move) begin
      word1 <= stored;
      pattern1 <= pattern;
      share1 <= shares[{stored[49:45], 4'd0}+:16];

      flow5 <= part4[31:16] < cap ? part4[31:16] : cap;
      part5 <= energy4[31:16] < cap ? energy4[31:16] : cap;

      pattern6 <= pattern5;
      amount6 <= pattern5 == 8'd0 ? 14'd0 : flow5[13:0];
      energy6 <= pattern5 == 8'd0 ? 14'd0 : part5[13:0];  // no more, as no cell has more energy than amount
      held6 <= word5[17:2];
      held_energy6 <= word5[33:18];
      heat6 <= word5[49:34];

      axes7 <= times(pattern6[3:0], amount6);
      axes_energy7 <= times(pattern6[3:0], energy6);
      corners7 <= times(pattern6[7:4], {2'd0, amount6[13:2]});
      corners_energy7 <= times(pattern6[7:4], {2'd0, energy6[13:2]});
      held7 <= held6;
      held_energy7 <= held_energy6;
      amount7 <= amount6;
      energy7 <= energy6;

      left8 <= held7 - axes7 - corners7;
      left_energy8 <= held_energy7 - axes_energy7 - corners_energy7;
      amount8 <= amount7;
      energy8 <= energy7;

      left_amount <= left8;
      left_energy <= left_energy8;
      amount <= amount8;
      energy <= energy8;
    end
endmodule
