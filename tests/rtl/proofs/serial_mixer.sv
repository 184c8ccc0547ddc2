// The serial divider of a loop gives what the pipelined one gives, after 23 cycles, and no later.
module proof (
    input logic clk,
    input logic [15:0] amount,
    input logic [15:0] heat,
    input logic [15:0] flow,
    input logic [15:0] flow_heat,
    input logic [15:0] dither
);
  logic works;
  logic [15:0] mixed, due;
  logic [4:0] so_far;
  logic [7:0] age;
  moves time_ (.clk(clk), .age(age));
  serial_mixer dut (
      .clk(clk), .rst(1'b0), .start(age != 8'd0), .move(age == 8'd0), .amount(amount), .heat(heat), .flow(flow),
      .flow_heat(flow_heat), .dither(dither), .works(works), .mixed(mixed), .count(so_far));
  logic signed [34:0] here, there, rounding;
  assign here = 35'($signed({2'b0, amount}) * $signed({1'b0, 1'b0, heat}));
  assign there = 35'($signed({2'b0, flow}) * $signed({1'b0, 1'b0, flow_heat}));
  wire [15:0] after = amount + flow;
  assign rounding = 35'($signed({2'b0, after}) * $signed({1'b0, 1'b0, dither}));
  wire [31:0] number = here[31:0] + there[31:0] + 32'(rounding[31:16]);
  logic [16:0] rest;  // as in the mixer, whose bits are proved
  logic [15:0] low;
  logic [17:0] left;
  always_comb begin
    rest = {1'b0, number[31:16]};
    low = number[15:0];
    for (int i = 0; i < 16; i++) begin
      left = {rest[15:0], low[15], 1'b0} - {{1'b0, after} ^ {17{rest[16]}}, rest[16]};
      low = {low[14:0], ~left[17]};
      rest = left[17:1];
    end
    due = low;
  end
  logic [79:0] held;
  past #(.WIDTH(80), .N(1)) operands (.clk(clk), .d({amount, heat, flow, flow_heat, dither}), .q(held));
  always_comb if (age > 8'd1) assume (held == {amount, heat, flow, flow_heat, dither});
  always_comb if (age > 8'd0 && age < 8'd24) begin
    works_so_long: assert (works);
  end
  always_comb if (age == 8'd24) begin
    ends: assert (~works);
    mixes: assert (mixed == due);
  end
endmodule
