// A word that waits for its eastern or northern cell: that cell is in register 1 when `word` comes, and its
// flow in register 6 when `turned` leaves (docs/automaton.md, section 6).
module conduction_side_lane #(
    parameter EXPOSED = 66  // bit of the axis
) (
    input  logic               clk,
    input  logic               move,
    input  logic [70:0]        word,
    input  logic               there,    // it comes in this very move
    input  logic [70:0]        other1,
    input  logic [15:0]        flow6,
    output logic [70:0]        turned    // 5 moves later
);
  logic [70:0] marked, word5;
  always_comb begin
    marked = word;
    marked[EXPOSED] = word[EXPOSED] | (there & (other1[1:0] == voxmelt_pkg::AIR) & (word[1] ^ word[0]));
    marked[69] = word[69] | (there & other1[1]);
    marked[70] = word[70] | (there & other1[1]);
  end
  delay #(.WIDTH(71), .N(5)) waits (.clk(clk), .en(move), .d(marked), .q(word5));
  always_comb begin
    turned = word5;
    if (word5[1] ^ word5[0]) turned[49:34] = word5[49:34] + flow6;
  end
endmodule
