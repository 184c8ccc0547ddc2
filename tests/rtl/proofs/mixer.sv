// A mixture's heat is a quotient (docs/automaton.md, section 2). Each register takes one bit of it: what is left
// of the number is two times the rest and the next bit, and the divisor is taken from it if that is no more. So
// the number is heat x amount + rest, and the rest is less than the amount. A register below 0 holds the rest
// less the divisor.
module proof (
    input logic clk,
    input logic [31:0] content,
    input logic [15:0] amount,
    input logic [15:0] dither
);
  logic [15:0] heat;
  logic [17*17-1:0] rest, rest1;
  logic [17*16-1:0] low, by, low1, by1;
  mixer dut (.clk(clk), .en(1'b1), .content(content), .amount(amount), .dither(dither), .heat(heat), .rest(rest),
             .low(low), .by(by));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  past #(.WIDTH(17 * 49), .N(1)) before (.clk(clk), .d({rest, low, by}), .q({rest1, low1, by1}));

  logic signed [34:0] rounding;
  assign rounding = 35'($signed({2'b0, amount}) * $signed({1'b0, 1'b0, dither}));
  logic [31:0] number4;
  logic [15:0] amount4;
  past #(.WIDTH(48), .N(4)) operands (
      .clk(clk), .d({content + 32'(rounding[31:16]), amount}), .q({number4, amount4}));
  always_comb if (age == 8'd4) begin
    begins: assert ({rest[16:0], low[15:0]} == {1'b0, number4} && by[15:0] == amount4);
  end

  function automatic [16:0] rest_of(input [16:0] held, input [15:0] divisor);
    rest_of = held[16] ? held + 17'(divisor) : held;
  endfunction

  logic takes, less, shifts;
  always_comb begin
    takes = 1'b1;
    less = 1'b1;
    shifts = heat == low[16*16+:16];
    for (int i = 0; i < 16; i++) begin
      takes = takes & (rest_of(rest1[17*i+:17], by1[16*i+:16]) >= 17'(by1[16*i+:16]) ||
          {rest_of(rest1[17*i+:17], by1[16*i+:16]), low1[16*i+15]} ==
              18'(rest_of(rest[17*i+17+:17], by[16*i+16+:16])) + (low[16*i+16] ? 18'(by1[16*i+:16]) : 18'd0));
      less = less & (rest_of(rest1[17*i+:17], by1[16*i+:16]) >= 17'(by1[16*i+:16]) ||
          rest_of(rest[17*i+17+:17], by[16*i+16+:16]) < 17'(by[16*i+16+:16]));
      shifts = shifts & low[16*i+17+:15] == low1[16*i+:15] & by[16*i+16+:16] == by1[16*i+:16];
    end
  end
  always_comb if (age == 8'd1) begin
    divides: assert (takes);
    rest_is_less: assert (less);
    bits_in_order: assert (shifts);
  end
endmodule
