// 2^(x / 65536) by the mean heat of a run, as `power` / 4096 and a shift to the right, which takes out those
// 12 bits, too (docs/automaton.md, section 10). The power of the fraction is a parabola of two products.
module warm_unit (
    input  logic        clk,
    input  logic        en,
    input  logic [15:0] mean,
    input  logic        thermal,   // else the power is 1
    input  logic [15:0] reference,
    input  logic [15:0] rate,
    output logic [12:0] power,     // 13 moves later, both
    output logic [5:0]  shift      // 5..44
);
  localparam signed [27:0] LEAST = -28'sd2097152, MOST = 28'sd524287;
  logic signed [17:0] above1;
  logic signed [34:0] octaves4, part8, part12;
  logic [21:0] x5;
  logic [15:0] fraction9, slope9;
  logic [5:0] shift6, shift12;
  wire signed [27:0] whole4 = octaves4[33:6];
  product of_rate (.clk(clk), .en(en), .a(above1), .b({1'b0, rate}), .p(octaves4));
  product first (.clk(clk), .en(en), .a(18'sd22479), .b({1'b0, x5[15:0]}), .p(part8));
  product second (.clk(clk), .en(en), .a($signed({2'b0, fraction9})), .b({1'b0, slope9}), .p(part12));
  delay #(.WIDTH(16), .N(4)) fractions (.clk(clk), .en(en), .d(x5[15:0]), .q(fraction9));
  delay #(.WIDTH(6), .N(6)) shifts (.clk(clk), .en(en), .d(shift6), .q(shift12));
  always_ff @(posedge clk)
    if (en) begin
      above1 <= $signed({2'b0, mean}) - $signed({2'b0, reference});
      x5 <= whole4 < LEAST ? LEAST[21:0] : whole4 > MOST ? MOST[21:0] : whole4[21:0];
      shift6 <= 6'd12 - x5[21:16];
      slope9 <= 16'd43057 + part8[31:16];
      power <= thermal ? 13'd4096 + part12[32:20] : 13'd4096;
      shift <= thermal ? shift12 : 6'd12;
    end
endmodule
