// The partial products by the parts of b, and their sum with their weights: a b.
module proof (
    input logic clk,
    input logic [23:0] a,
    input logic [13:0] b
);
  localparam A = 24, S = 4;
  logic [37:0] p;
  logic [4*(A+S)-1:0] parts;
  long_product dut (.clk(clk), .en(1'b1), .a(a), .b(b), .p(p), .parts(parts));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [A-1:0] a1;
  logic [15:0] b1;
  past #(.WIDTH(A + 16), .N(1)) operands (.clk(clk), .d({a, 2'b0, b}), .q({a1, b1}));
  logic [39:0] due, due2;
  assign due = 40'(parts[0+:A+S]) + (40'(parts[A+S+:A+S]) << S) + (40'(parts[2*(A+S)+:A+S]) << (2 * S)) +
      (40'(parts[3*(A+S)+:A+S]) << (3 * S));
  past #(.WIDTH(40), .N(2)) sums (.clk(clk), .d(due), .q(due2));
  always_comb if (age == 8'd1) begin
    parts_of_b: assert (parts == {28'(a1) * 28'(b1[15:12]), 28'(a1) * 28'(b1[11:8]), 28'(a1) * 28'(b1[7:4]),
                                  28'(a1) * 28'(b1[3:0])});
  end
  // No part is beyond its product. But for that, the parts of the sum may be any.
  always_comb
    if (age == 8'd0)
      for (int i = 0; i < 4; i++) assume (parts[i*(A+S)+:A+S] <= 28'hFFFFFF * 28'd15);
  always_comb if (age == 8'd2) begin
    sum: assert (p == due2[37:0]);
  end
endmodule
