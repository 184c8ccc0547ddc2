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

  // Of the division, after so many bits. A rest below 0 gets the divisor with the next bit. So a bit is one sum,
  // without a choice behind it.
  logic [17*17-1:0] rest /*verilator split_var*/;
  logic [17*16-1:0] low /*verilator split_var*/, by /*verilator split_var*/;
  wire [31:0] number = content3 + 32'(rounding[31:16]);
  always_ff @(posedge clk)
    if (en) begin
      rest[0+:17] <= {1'b0, number[31:16]};
      low[0+:16] <= number[15:0];
      by[0+:16] <= amount3;
    end
  for (genvar bit_ = 0; bit_ < 16; bit_++) begin : bits
    wire [15:0] divisor = by[16*bit_+:16];
    wire below = rest[17*bit_+16];
    wire [17:0] left = {rest[17*bit_+:16], low[16*bit_+15], 1'b0} - {{1'b0, divisor} ^ {17{below}}, below};
    always_ff @(posedge clk)
      if (en) begin
        rest[17*bit_+17+:17] <= left[17:1];
        low[16*bit_+16+:16] <= {low[16*bit_+:15], ~left[17]};
        by[16*bit_+16+:16] <= divisor;
      end
  end
  assign heat = low[16*16+:16];
endmodule
