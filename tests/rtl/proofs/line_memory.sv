// A word comes out so many moves later, whatever the pauses. Any word is followed.
module proof (
    input logic clk,
    input logic en,
    input logic d,
    input logic [23:0] delay_,
    input logic chosen
);
  logic q, following, due, value;
  logic [23:0] delay1, left;
  logic [7:0] age;
  moves time_ (.clk(clk), .age(age));
  wire rst = age == 8'd0;
  line_memory dut (.clk(clk), .rst(rst), .en(en), .delay(delay_), .d(d), .q(q));
  past #(.WIDTH(24), .N(1)) stays (.clk(clk), .d(delay_), .q(delay1));
  always_comb begin
    assume (delay_ >= 24'd2 && delay_ <= 24'd4);
    if (age != 8'd0) assume (delay_ == delay1);
  end
  always_ff @(posedge clk)
    if (rst) begin
      following <= 1'b0;
      due <= 1'b0;
    end else if (en) begin
      if (~following & chosen) begin
        following <= 1'b1;
        value <= d;
        left <= delay_ - 24'd1;
      end else if (following) left <= left - 24'd1;
      due <= following & left == 24'd1;
      if (due) following <= 1'b0;
    end
  always_comb if (due & age != 8'd0) begin
    comes_back: assert (q == value);
  end
endmodule
