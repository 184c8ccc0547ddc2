// Three partial products, and their sum with their weights: a b, as b is the sum of its parts.
module proof (
    input logic clk,
    input logic signed [17:0] a,
    input logic [16:0] b
);
  logic signed [34:0] p;
  logic signed [23:0] low, middle;
  logic signed [22:0] high;
  product dut (.clk(clk), .en(1'b1), .a(a), .b(b), .p(p), .low(low), .middle(middle), .high(high));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic signed [17:0] a1;
  logic [16:0] b1;
  past #(.WIDTH(35), .N(1)) operands (.clk(clk), .d({a, b}), .q({a1, b1}));
  logic signed [34:0] due, due2;
  assign due = 35'(low) + (35'(middle) <<< 6) + (35'(high) <<< 12);
  past #(.WIDTH(35), .N(2)) sums (.clk(clk), .d(due), .q(due2));
  always_comb if (age == 8'd1) begin
    parts_low: assert (low == 24'(a1 * $signed({1'b0, b1[5:0]})));
    parts_middle: assert (middle == 24'(a1 * $signed({1'b0, b1[11:6]})));
    parts_high: assert (high == 23'(a1 * $signed({1'b0, b1[16:12]})));
  end
  // No part is beyond the range of its product. But for that, the parts of the sum may be any.
  function automatic within(input signed [23:0] part, input signed [23:0] most);
    within = part >= -24'sd131072 * most && part <= 24'sd131071 * most;
  endfunction
  always_comb if (age == 8'd0) begin
    assume (within(low, 24'sd63));
    assume (within(middle, 24'sd63));
    assume (within(24'(high), 24'sd31));
  end
  always_comb if (age == 8'd2) begin
    sum: assert (p == due2);
  end
endmodule
