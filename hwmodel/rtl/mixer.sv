// Heat of a mixture: (content + (amount x dither >> 16)) / amount, a bit of the quotient per register
// (docs/automaton.md, section 4). The quotient has 16 bits, as no heat exceeds those of its parts.
module mixer (
    input  logic        clk,
    input  logic        en,
    input  logic [31:0] content,
    input  logic [15:0] amount,
    input  logic [15:0] dither,
    output logic [15:0] heat     // 20 moves later
);
  logic signed [34:0] rounding;
  logic [31:0] content3;
  logic [15:0] amount3;
  product times_dither (.clk(clk), .en(en), .a($signed({2'b0, amount})), .b({1'b0, dither}), .p(rounding));
  delay #(.WIDTH(48), .N(3)) waits (.clk(clk), .en(en), .d({content, amount}), .q({content3, amount3}));

  logic [17*16-1:0] rest, low;  // of the division, after so many bits
  logic [17*16-1:0] by;
  wire [31:0] number = content3 + 32'(rounding[31:16]);
  always_ff @(posedge clk)
    if (en) begin
      rest[0+:16] <= number[31:16];
      low[0+:16] <= number[15:0];
      by[0+:16] <= amount3;
    end
  for (genvar bit_ = 0; bit_ < 16; bit_++) begin : bits
    wire [15:0] divisor = by[16*bit_+:16];
    wire [16:0] whole = {rest[16*bit_+:16], low[16*bit_+15]};
    wire fits = whole >= {1'b0, divisor};
    wire [16:0] less = whole - {1'b0, divisor};
    always_ff @(posedge clk)
      if (en) begin
        rest[16*bit_+16+:16] <= fits ? less[15:0] : whole[15:0];
        low[16*bit_+16+:16] <= {low[16*bit_+:15], fits};
        by[16*bit_+16+:16] <= divisor;
      end
  end
  assign heat = low[16*16+:16];
endmodule
