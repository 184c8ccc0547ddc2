// A cell of spread whose pairs are done (docs/automaton.md, section 11).
module proof (
    input logic clk,
    input logic [35:0] word23,
    input logic [15:0] amount26,
    input logic [31:0] content26,
    input logic [15:0] dither27,
    input logic hot,
    input logic finds_walls
);
  voxmelt_pkg::cell_t cell_out;
  logic in_run;
  logic [31:0] content27;
  spread_finish dut (
      .clk(clk), .move(1'b1), .word23(word23), .amount26(amount26), .content26(content26), .dither27(dither27),
      .hot(hot), .finds_walls(finds_walls), .cell_out(cell_out), .in_run(in_run), .content27(content27));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [35:0] word;
  logic [15:0] got;
  logic signed [34:0] held;
  logic [31:0] held3, sum1;
  assign held = 35'($signed({2'b0, word23[19:4]}) * $signed({1'b0, 1'b0, word23[35:20]}));
  past #(.WIDTH(32), .N(3)) contents (.clk(clk), .d(held[31:0]), .q(held3));
  past #(.WIDTH(32), .N(1)) sum (.clk(clk), .d(held3 + content26), .q(sum1));
  past #(.WIDTH(36), .N(25)) comes (.clk(clk), .d(word23), .q(word));
  past #(.WIDTH(16), .N(22)) gets (.clk(clk), .d(amount26), .q(got));
  wire blocked = word[1];
  always_comb if (age == 8'd4) begin
    content_is_held_and_got: assert (content27 == sum1);
  end
  always_comb if (age == 8'd25) begin
    amount_is_held_and_got: assert (cell_out.amount == (blocked ? word[19:4] : word[19:4] + got));
    blocked_stays: assert (~blocked | (cell_out.heat == word[35:20] && cell_out.state == word[1:0]));
    air_has_nothing: assert (blocked | cell_out.amount != 16'd0 |
                             (cell_out.heat == 16'd0 && cell_out.state == voxmelt_pkg::AIR));
  end
endmodule
