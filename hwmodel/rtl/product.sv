// A product over three registers. In logic, each register ends one sum. With VOXMELT_BLOCKS it is left to a
// multiplier block and its registers: of its operands, of the product, and behind it.
module product #(
    parameter B = 17
) (
    input  logic                 clk,
    input  logic                 en,
    input  logic signed [17:0]   a,
    input  logic        [B-1:0]  b,
    output logic signed [B+17:0] p  // three moves later
);
`ifdef VOXMELT_BLOCKS
  logic signed [17:0] a1;
  logic [B-1:0] b1;
  logic signed [B+17:0] p2;
  always_ff @(posedge clk)
    if (en) begin
      a1 <= a;
      b1 <= b;
      p2 <= (B + 18)'(a1 * $signed({1'b0, b1}));
      p <= p2;
    end
`else
  localparam S = (B + 2) / 3, T = B - 2 * S;  // bits of a third, and of the last one
  logic signed [S+17:0] low, middle;
  logic signed [T+17:0] high, high2;
  logic signed [2*S+17:0] both;
  always_ff @(posedge clk)
    if (en) begin
      low <= (S + 18)'(a * $signed({1'b0, b[S-1:0]}));
      middle <= (S + 18)'(a * $signed({1'b0, b[2*S-1:S]}));
      high <= (T + 18)'(a * $signed({1'b0, b[B-1:2*S]}));
      both <= (2 * S + 18)'(low) + $signed({middle, {S{1'b0}}});
      high2 <= high;
      p <= (B + 18)'(both) + $signed({high2, {(2 * S) {1'b0}}});
    end
`endif
endmodule
