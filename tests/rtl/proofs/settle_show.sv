// The third scan of settle (docs/automaton.md, section 10): what a run has is what its cells get, and what it still
// has for those above.
module proof (
    input logic clk,
    input logic [75:0] word1,
    input logic [11:0] y10
);
  localparam SUM = 28, LAST = 12;
  logic [SUM-1:0] level10_now, level11;
  logic signed [SUM+1:0] spare10_now, spare11;
  logic [12:0] base11;
  logic [15:0] more11, amount12;
  logic [2:0] kind11;
  show_scan dut (
      .clk(clk), .move(1'b1), .word1(word1), .y10(y10), .pace10(36'd0), .hot(1'b0), .thermal(1'b0),
      .mobility_reference(16'd0), .mobility_rate(16'd0), .yield_stress(24'd0), .stiffness(4'd0),
      .beds(48'd0), .level10_now(level10_now),
      .level11(level11), .spare10_now(spare10_now), .spare11(spare11), .base11(base11), .more11(more11),
      .amount12(amount12), .kind11(kind11));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [SUM-1:0] had;
  logic signed [SUM+1:0] over;
  past #(.WIDTH(2 * SUM + 2), .N(1)) before (.clk(clk), .d({level10_now, spare10_now}), .q({had, over}));
  // What goes to a cell beyond ONE is what the cells above it cannot hold. There is never more than one can.
  always_comb if (age == 8'd0) assume (spare10_now <= 30'sd61439 && spare10_now > -30'sd268435456);
  always_comb if (age == 8'd1) begin
    level_telescopes: assert (SUM'(base11) + level11 == had);
    cell_is_full_or_last: assert (base11 == 13'd4096 || (base11 < 13'd4096 && level11 == '0));
    more_as_the_page: assert (more11 == (over < 30'sd0 ? 16'd0 : over[15:0]));
    spare_telescopes: assert (spare11 == (over < 30'sd0 ? over : 30'sd0) + 30'sd61439);
    no_more_than_a_cell_holds: assert (17'(base11) + 17'(more11) <= 17'd65535);
  end
endmodule
