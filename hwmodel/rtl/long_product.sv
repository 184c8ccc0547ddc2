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
  localparam S = (B + 3) / 4;  // bits of a quarter
  wire [4*S-1:0] whole = (4 * S)'(b);
  logic [4*(A+S)-1:0] parts;
  logic [A+2*S-1:0] low, high;
  for (genvar i = 0; i < 4; i++) begin : quarters
    always_ff @(posedge clk)
      if (en) parts[i*(A+S)+:A+S] <= (A + S)'(a) * (A + S)'(whole[i*S+:S]);
  end
  wire [A+4*S-1:0] sum = (A + 4 * S)'(low) + {high, {(2 * S) {1'b0}}};
  always_ff @(posedge clk)
    if (en) begin
      low <= (A + 2 * S)'(parts[0+:A+S]) + {parts[A+S+:A+S], {S{1'b0}}};
      high <= (A + 2 * S)'(parts[2*(A+S)+:A+S]) + {parts[3*(A+S)+:A+S], {S{1'b0}}};
      p <= sum[A+B-1:0];
    end
`endif
endmodule
