// How the pairs of one axis round (docs/automaton.md, section 11): R of the layer y in this sub-step.
module pair_dither #(
    parameter [15:0] SHIFT = 16'd0  // axis x 65536 / 4
) (
    input  logic        clk,
    input  logic        move,
    input  logic [11:0] y11,
    input  logic [15:0] dither11,      // of the step
    input  logic [36:0] reciprocal11,  // of the number of sub-steps, in 1/2^36
    input  logic [9:0]  turn11,        // which of them this one is for the axis
    output logic [15:0] rounding16
);
  logic [15:0] layer, offset12;
  logic [36:0] reciprocal12;
  logic [9:0] turn12;
  logic [33:0] low15;
  logic [34:0] high15;
  logic [52:0] sum16;
  logic [46:0] turned15;
  dither_unit of_layer (.step(32'(y11)), .dither(layer));
  // The part of a layer is a product of two halves, whose carries are short.
  long_product #(.A(18), .B(16)) lower_half (.clk(clk), .en(move), .a(reciprocal12[17:0]), .b(offset12), .p(low15));
  long_product #(.A(19), .B(16)) upper_half (.clk(clk), .en(move), .a(reciprocal12[36:18]), .b(offset12), .p(high15));
  long_product #(.A(37), .B(10)) turns (.clk(clk), .en(move), .a(reciprocal12), .b(turn12), .p(turned15));
  assign rounding16 = sum16[51:36];
  always_ff @(posedge clk)
    if (move) begin
      offset12 <= dither11 + layer + SHIFT;
      reciprocal12 <= reciprocal11;
      turn12 <= turn11;
      sum16 <= {19'd0, low15} + {high15, 18'd0} + {turned15[36:0], 16'd0};
    end
endmodule
