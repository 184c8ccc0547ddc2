// A product of wide numbers over three registers. In logic, each register ends one sum of a few rows. With
// VOXMELT_BLOCKS it is left to multiplier blocks and their registers.
module long_product #(
    parameter A = 29,
    parameter B = 18
) (
    input  logic           clk,
    input  logic           en,
    input  logic [A-1:0]   a,
    input  logic [B-1:0]   b,
    output logic [A+B-1:0] p  // three moves later
);
`ifdef VOXMELT_BLOCKS
  logic [A+B-1:0] p1, p2;
  always_ff @(posedge clk)
    if (en) begin
      p1 <= (A + B)'(a) * (A + B)'(b);
      p2 <= p1;
      p <= p2;
    end
`else
  localparam PAIRS = B > 14 ? 3 : 2, S = (B + 2 * PAIRS - 1) / (2 * PAIRS);  // of parts; bits of a part
  wire [2*PAIRS*S-1:0] whole = (2 * PAIRS * S)'(b);
  logic [2*PAIRS*(A+S)-1:0] parts;
  wire [3*(A+2*S)-1:0] sums;  // a third pair may be none
  for (genvar i = 0; i < 2 * PAIRS; i++) begin : all_parts
    always_ff @(posedge clk)
      if (en) parts[i*(A+S)+:A+S] <= (A + S)'(a) * (A + S)'(whole[i*S+:S]);
  end
  for (genvar i = 0; i < 3; i++) begin : pairs
    if (i < PAIRS) begin : pair
      logic [A+2*S-1:0] both;
      assign sums[i*(A+2*S)+:A+2*S] = both;
      always_ff @(posedge clk)
        if (en) both <= (A + 2 * S)'(parts[2*i*(A+S)+:A+S]) + {parts[(2*i+1)*(A+S)+:A+S], {S{1'b0}}};
    end else begin : none
      assign sums[i*(A+2*S)+:A+2*S] = '0;
    end
  end
  wire [A+6*S-1:0] sum = (A + 6 * S)'(sums[0+:A+2*S]) + ((A + 6 * S)'(sums[A+2*S+:A+2*S]) << (2 * S)) +
      ((A + 6 * S)'(sums[2*(A+2*S)+:A+2*S]) << (4 * S));
  always_ff @(posedge clk)
    if (en) p <= sum[A+B-1:0];
`endif
endmodule
