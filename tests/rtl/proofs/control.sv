// The control of a stage, for small tiles and lags, with any pauses at both ends, from its reset on.
module proof (
    input logic clk,
    input logic in_valid,
    input logic out_ready,
    input logic follows,
    input voxmelt_pkg::place_t last,
    input logic [23:0] lag
);
  logic in_ready, out_valid, move, here, overlaps, drained;
  voxmelt_pkg::place_t came, left, last1;
  logic [23:0] fill, lag1;
  logic [31:0] step_came, step_left;
  logic [7:0] age;
  moves time_ (.clk(clk), .age(age));
  wire rst = age == 8'd0;
  stage_control dut (
      .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .out_ready(out_ready),
      .hold(1'b0), .follows(follows), .step(32'd0), .last(last), .lag(lag), .move(move), .here(here),
      .overlaps(overlaps), .came(came), .left(left), .step_came(step_came), .step_left(step_left), .fill(fill),
      .drained(drained));
  past #(.WIDTH(60), .N(1)) stay (.clk(clk), .d({last, lag}), .q({last1, lag1}));
  always_comb begin
    assume (lag >= 24'd1 && lag <= 24'd2);
    assume (last.y <= 12'd1 && last.block <= 12'd1 && last.plane == 12'd0);
    assume (lag <= 24'(last.y) + 24'd1);  // no more than the tokens of a pass
    if (age != 8'd0) assume (last == last1 && lag == lag1);
  end
  // Who offers a token goes on with it until it is taken. So it is with a pass that follows.
  logic offers, waits, was_following;
  always_ff @(posedge clk) begin
    offers <= in_valid & ~in_ready & ~rst;
    waits <= out_valid & ~out_ready & ~rst;
    was_following <= follows & ~move & ~rst;
  end
  always_comb if (age > 8'd1) assume (in_valid | ~offers);
  always_comb if (age > 8'd1) assume (follows == was_following || move_before);
  logic move_before;
  past #(.WIDTH(1), .N(1)) moved (.clk(clk), .d(move | rst), .q(move_before));

  // How many tokens are in the stage, and which leaves next. Tokens of a pass leave in their order.
  wire put = in_valid & in_ready, get = out_valid & out_ready;
  logic [7:0] inside_;
  logic [3:0] quiet;  // cycles without a token taken, where the next stage is ready
  always_ff @(posedge clk)
    if (rst) begin
      inside_ <= 8'd0;
      quiet <= 4'd0;
    end else begin
      inside_ <= inside_ + 8'(put) - 8'(get);
      quiet <= in_ready | ~out_ready ? 4'd0 : quiet + 4'd1;
    end
  voxmelt_pkg::place_t came_before, left_before;
  logic any_came, any_left;
  always_ff @(posedge clk)
    if (rst) {any_came, any_left} <= 2'b00;
    else begin
      if (put) came_before <= came;
      if (get) left_before <= left;
      any_came <= any_came | put;
      any_left <= any_left | get;
    end
  function automatic follows_on(input [35:0] a, input [35:0] b);
    follows_on = b[11:0] == (a[11:0] == last.y ? 12'd0 : a[11:0] + 12'd1)
        && b[23:12] == (a[11:0] != last.y ? a[23:12] : a[23:12] == last.block ? 12'd0 : a[23:12] + 12'd1)
        && b[35:24] == (a[11:0] != last.y || a[23:12] != last.block ? a[35:24] : a[35:24] == last.plane ? 12'd0
                                                                                  : a[35:24] + 12'd1);
  endfunction
  always_comb if (age > 8'd1) begin
    offered_until_taken: assert (~waits | out_valid);
    no_more_than_the_lag: assert (inside_ <= 8'(lag));
    none_from_nothing: assert (~get | inside_ != 8'd0 | (put & lag == 24'd0));
    empties_itself: assert (~(drained & move) | inside_ == 8'd1);
    comes_in_order: assert (~put | (any_came ? follows_on(came_before, came) : came == '0));
    leaves_in_order: assert (~get | (any_left ? follows_on(left_before, left) : left == '0));
    takes_again: assert (quiet <= 4'd2);
  end
endmodule
