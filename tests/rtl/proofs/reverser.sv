// Columns leave turned. A word of any column is followed: it leaves with the next column, at its mirrored place.
module proof (
    input logic clk,
    input logic en,
    input logic d,
    input logic [11:0] last_y,
    input logic chosen
);
  logic q, pass_q, following, due, value;
  logic [11:0] at_q, last1, at, moves_left;
  logic [7:0] age;
  moves time_ (.clk(clk), .age(age));
  wire rst = age == 8'd0;
  column_reverser dut (.clk(clk), .rst(rst), .restart(1'b0), .en(en), .last_y(last_y), .d(d), .pass(1'b0), .q(q),
                       .at_q(at_q), .pass_q(pass_q));
  past #(.WIDTH(12), .N(1)) stays (.clk(clk), .d(last_y), .q(last1));
  always_comb begin
    assume (last_y <= 12'd3);
    if (age != 8'd0) assume (last_y == last1);
  end
  // A word at place `at` comes; its column ends after last_y - at moves, and it leaves last_y - at moves later.
  logic [11:0] place;
  always_ff @(posedge clk)
    if (rst) begin
      following <= 1'b0;
      due <= 1'b0;
      place <= 12'd0;
    end else if (en) begin
      place <= place == last_y ? 12'd0 : place + 12'd1;
      if (~following & chosen) begin
        following <= 1'b1;
        value <= d;
        at <= place;
        moves_left <= ((last_y - place) << 1) + 12'd1;
      end else if (following) moves_left <= moves_left - 12'd1;
      due <= following & moves_left == 12'd1;
      if (due) following <= 1'b0;
    end
  always_comb if (due & age != 8'd0) begin
    mirrored: assert (q == value);
    place_is_told: assert (at_q == last_y - at);
  end
endmodule
