// The weight of the pairs of two materials. A wall counts as being of its neighbour's material (docs/automaton.md,
// section 6).
module pair_weight #(
    parameter MATERIALS = 0
) (
    input  logic        clk,
    input  logic        en,
    input  logic [4:0]  p,       // {matter, material}
    input  logic [4:0]  q,
    input  logic [(16<<(2*MATERIALS))-1:0] weights,
    output logic [15:0] weight   // a move later; that of one material is there at once
);
  if (MATERIALS != 0) begin : many
    wire [3:0] of_p = p[4] ? p[3:0] : q[3:0], of_q = q[4] ? q[3:0] : p[3:0];
    wire [2*MATERIALS-1:0] pair = {of_p[MATERIALS-1:0], of_q[MATERIALS-1:0]};
    always_ff @(posedge clk) if (en) weight <= weights[16*pair+:16];
  end else begin : one
    assign weight = weights;
  end
endmodule
