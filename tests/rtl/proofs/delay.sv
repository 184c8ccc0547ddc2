// The delay that a simulator takes gives what the registers give, however often a move waits. Data are one bit wide,
// since no bit meets another.
module proof (
    input logic clk,
    input logic en,
    input logic d
);
  logic q;
  logic [4:0] words;
  delay_ring #(.WIDTH(1), .N(5)) dut (.clk(clk), .en(en), .d(d), .q(q));
  always_ff @(posedge clk) if (en) words <= {words[3:0], d};
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  // Both forget what they held: after five moves only these count.
  logic [3:0] moved;
  initial moved = 4'd0;
  always_ff @(posedge clk) if (en && moved != 4'd5) moved <= moved + 4'd1;
  always_comb if (age <= 8'd16) begin
    ring_is_registers: assert (moved != 4'd5 | q == words[4]);
  end
endmodule
