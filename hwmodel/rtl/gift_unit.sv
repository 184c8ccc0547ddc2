// What a cell gives to each of its directions, and what it keeps (docs/automaton.md, section 9). A diagonal
// gets a quarter. Gifts are {content, energy, amount}, where the content is amount x heat.
//
// Without TABLE all axes get the same. Without PRINTED no friction acts here.
module gift_unit #(
    parameter TABLE = 1,
    parameter PRINTED = 1
) (
    input  logic          clk,
    input  logic          move,
    input  logic [49:0]   stored,
    input  logic [7:0]    pattern,
    input  logic [1:0]    footing,       // 0 liquid, 1 solid, 2 floor
    input  logic [511:0]  shares,        // by temperature, 32 of them
    input  logic          by_table,
    input  logic [1023:0] table_shares,  // by the pattern's axes, four each
    input  logic          printed,
    input  logic [47:0]   alpha,
    input  logic          eight,
    output logic [255:0]  axes,          // to each axis, 9 moves later
    output logic [63:0]   corner,        // to a diagonal
    output logic [15:0]   left_amount,   // 11 moves later
    output logic [15:0]   left_energy
);
  localparam WAYS = TABLE != 0 ? 4 : 1;
  wire [15:0] cap = eight ? 16'd4096 : 16'd8192;
  logic [49:0] word1, word5, word6;
  logic [7:0] pattern1, pattern5, pattern9;
  logic [31:0] held9, held10;
  logic [15:0] axes10, axes_energy10, corners10, corners_energy10, alpha6;
  logic [WAYS*16-1:0] flow5, part5;
  logic [WAYS*14-1:0] amounts6, energies6;
  delay #(.WIDTH(58), .N(4)) waits (
      .clk(clk), .en(move), .d({pattern1, word1}), .q({pattern5, word5}));
  delay #(.WIDTH(40), .N(4)) keeps (
      .clk(clk), .en(move), .d({pattern5, word5[33:2]}), .q({pattern9, held9}));

  if (PRINTED != 0) begin : rubs
    logic [1:0] footing6;
    delay #(.WIDTH(2), .N(6)) feet (.clk(clk), .en(move), .d(footing), .q(footing6));
    assign alpha6 = footing6 == 2'd0 ? alpha[15:0] : footing6 == 2'd1 ? alpha[31:16] : alpha[47:32];
  end else begin : glides
    assign alpha6 = 16'd0;
  end

  for (genvar way = 0; way < WAYS; way++) begin : ways
    logic [15:0] share1;
    logic signed [34:0] part4, energy4;
    product of_amount (.clk(clk), .en(move), .a($signed({2'b0, word1[17:2]})), .b({1'b0, share1}), .p(part4));
    product of_energy (.clk(clk), .en(move), .a($signed({2'b0, word1[33:18]})), .b({1'b0, share1}), .p(energy4));
    sent_unit #(.PRINTED(PRINTED)) sent (
        .clk(clk), .move(move), .amount(amounts6[way*14+:14]), .energy(energies6[way*14+:14]),
        .heat(word6[49:34]), .alpha(alpha6), .printed(printed), .gift(axes[way*64+:64]));
    always_ff @(posedge clk)
      if (move) begin
        share1 <= TABLE != 0 && by_table ? table_shares[{pattern[3:0], 2'(way), 4'd0}+:16]
                                         : shares[{stored[49:45], 4'd0}+:16];
        flow5[way*16+:16] <= part4[31:16] < cap ? part4[31:16] : cap;
        part5[way*16+:16] <= energy4[31:16] < cap ? energy4[31:16] : cap;
        amounts6[way*14+:14] <= pattern5 == 8'd0 ? 14'd0 : flow5[way*16+:14];
        energies6[way*14+:14] <= pattern5 == 8'd0 ? 14'd0 : part5[way*16+:14];  // no cell has more energy than amount
      end
  end
  for (genvar way = WAYS; way < 4; way++) begin : alike
    assign axes[way*64+:64] = axes[63:0];
  end
  sent_unit #(.PRINTED(PRINTED)) sent_corner (
      .clk(clk), .move(move), .amount({2'd0, amounts6[13:2]}), .energy({2'd0, energies6[13:2]}),
      .heat(word6[49:34]), .alpha(alpha6), .printed(printed), .gift(corner));

  function automatic [15:0] four(input [3:0] to, input [15:0] a, input [15:0] b, input [15:0] c, input [15:0] d);
    four = ((a & {16{to[0]}}) + (b & {16{to[1]}})) + ((c & {16{to[2]}}) + (d & {16{to[3]}}));
  endfunction

  always_ff @(posedge clk)
    if (move) begin
      word1 <= stored;
      pattern1 <= pattern;
      word6 <= word5;

      axes10 <= four(pattern9[3:0], axes[15:0], axes[79:64], axes[143:128], axes[207:192]);
      axes_energy10 <= four(pattern9[3:0], axes[31:16], axes[95:80], axes[159:144], axes[223:208]);
      corners10 <= four(pattern9[7:4], corner[15:0], corner[15:0], corner[15:0], corner[15:0]);
      corners_energy10 <= four(pattern9[7:4], corner[31:16], corner[31:16], corner[31:16], corner[31:16]);
      held10 <= held9;

      left_amount <= held10[15:0] - axes10 - corners10;
      left_energy <= held10[31:16] - axes_energy10 - corners_energy10;
    end
endmodule
